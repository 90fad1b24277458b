# %% [markdown]
# # A colloidal probe on a gel
#
# A glass sphere of radius 10 µm on a cantilever touches a layer of gel, 5 µm thick, on glass.
# Adhesion is larger on retract than on approach. The height of the cantilever's base and the force
# are measured.

# %%
import matplotlib.pyplot as plt
import numpy as np

from coated_contact import (
    Elastic,
    Experiment,
    Hysteresis,
    Spring,
    System,
    Table,
    fit,
    predict,
    simulate,
)

glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
system = System(
    sphere_radius=10e-6,
    sphere_modulus=glass.reduced_modulus,
    film=Elastic(young_modulus=2e4, poisson_ratio=0.49),
    film_thickness=5e-6,
    substrate=glass,
)
contact = Table.embedded().contact(system)
contact

# %% [markdown]
# ## Does the model hold?
#
# Tabor's parameter should be above 5, and the contact small beside the sphere.

# %%
pull_off = contact.pull_off(1e-3, control=Spring(stiffness=0.1))
validity = contact.validity(pull_off.contact_radius)
attraction = contact.zone_size(1e-3)
print(f"a/R {validity.a_over_r:.2f}, a/t {validity.a_over_t:.2f}, Tabor {attraction.tabor:.0f}")

# %% [markdown]
# ## Hysteresis
#
# The line is pinned between the two energies.

# %%
line = contact.line(Hysteresis(advancing=2e-4, receding=1e-3), 0.5e-6)
cantilever = Spring(stiffness=0.1)
positions = np.concatenate([np.linspace(0, 1.5e-6, 150), np.linspace(1.5e-6, -1.5e-6, 600)])
states = [line.impose(cantilever, position) for position in positions]
seen = [state for state in states if state is not None]
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
axes.plot([1e6 * s.penetration for s in seen], [1e9 * s.load for s in seen])
axes.set_xlabel("penetration (µm)")
axes.set_ylabel("load (nN)")

# %% [markdown]
# ## A measured curve
#
# Synthetic, with 50 pN of noise. Approach and retract are fitted together. Which points are in
# contact is read from the data.

# %%
down = np.linspace(4e-6, 1.5e-6, 300)
truth = Experiment(
    kind="force-height",
    abscissa=np.concatenate([down, down[::-1]]),
    retract=np.repeat([False, True], 300),
    system=system,
    work_of_adhesion=2e-4,
    work_of_adhesion_receding=1e-3,
    contact_point=2e-6,
    baseline=1e-10,
    stiffness=0.1,
    noise=5e-11,
    name="curve",
)
measured = simulate(truth, noise=5e-11, seed=3)
found = fit(
    measured,
    ["film_modulus", "work_of_adhesion", "work_of_adhesion_receding", "contact_point", "baseline"],
)
found

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
found.plot(axes)

# %% [markdown]
# ## Other methods
#
# `predict` gives the same ordinates with their exact derivatives, for any method; the class
# `coated_contact.lmfit.Model` hands them to lmfit.

# %%
prediction = predict(truth, ["film_modulus", "contact_point"])
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
for name, derivative in prediction.derivatives.items():
    axes.plot(derivative / np.abs(derivative).max(), label=name)
axes.set_xlabel("point")
axes.set_ylabel("derivative of the force, over its largest")
axes.legend()
