# %% [markdown]
# # A JKR lens on a film
#
# An elastomer lens of radius 1 mm touches a film of 30 µm on silicon. Contact radii are seen
# through the lens, loads are measured by a balance. We plan the experiment, make synthetic data,
# fit them, and see what JKR without the film would have given.

# %%
import matplotlib.pyplot as plt
import numpy as np

from coated_contact import Elastic, Experiment, System, Table, fit, forecast, simulate

system = System(
    sphere_radius=1e-3,
    sphere_modulus=2e6,  # the reduced modulus E2*
    film=Elastic(young_modulus=3.5e5, poisson_ratio=0.49),
    film_thickness=3e-5,
    substrate=Elastic(young_modulus=2e11, poisson_ratio=0.25),
)
contact = Table.embedded().contact(system)
contact

# %% [markdown]
# ## The force curve
#
# A dead weight on the lens, and a rigid machine: the dashed lines are the jumps.

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
contact.force_displacement(0.04, control="load", most=1e-3).plot(left)
contact.force_displacement(0.04, control="displacement", most=4e-6).plot(right)
left.set_title("imposed load")
right.set_title("imposed penetration")
right.legend()

# %% [markdown]
# ## Before measuring
#
# Which errors would 15 or 60 radii give, with loads good to 2 µN?

# %%
free = ["sphere_modulus", "film_modulus", "work_of_adhesion"]


def plan(points):
    return Experiment(
        kind="load-radius",
        abscissa=np.linspace(4e-5, 1.3e-4, points),
        system=system,
        work_of_adhesion=0.04,
        noise=2e-6,
        name="lens",
    )


for points in (15, 60):
    expected = forecast(plan(points), free)
    print(points, {name: f"{error:.2g}" for name, error in expected.stderr.items()})

# %% [markdown]
# ## The fit
#
# It starts from the data. The dotted line is the best fit without the film.

# %%
measured = simulate(plan(60), noise=2e-6, seed=1)
found = fit(measured, free)
found

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
found.plot(axes)

# %%
bare = found.without_film
print(f"without the film {bare.modulus} would be wrong by {100 * bare.relative_error:+.0f} %")
