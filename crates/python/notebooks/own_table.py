# %% [markdown]
# # A table of one's own, with xarray
#
# The embedded table serves every system. A table of one's own is of use where its accuracy is too
# low, where gradients of the dimensionless quantities are wanted as arrays, or for other programs.

# %%
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from coated_contact import Elastic, Layer, Stack, StackSystem, System, Table, generate, solve

# %% [markdown]
# ## Scene and table
#
# A mapping gives an axis, a number holds a parameter fixed. Ctrl-C keeps the pieces that are
# solved, and `resume=True` goes on from them.

# %%
scene = {
    "title": "An incompressible film on a rigid base",
    "tolerance": 1e-7,
    "a_over_t": {"from": 1e-2, "to": 1e2},
    "e1_over_e2": {"from": 1e-2, "to": 1e2},
    "nu1": 0.5,
    "e0_over_e2": np.inf,
}
folder = tempfile.TemporaryDirectory()
path = Path(folder.name) / "films.bin"
table = generate(scene, path, progress=False)
print(table, f"largest error {table.max_error:.1e}, {path.stat().st_size} bytes")

# %% [markdown]
# ## As arrays

# %%
data = table.to_xarray().squeeze()
data

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
for ratio in (0.01, 0.1, 1.0, 10.0, 100.0):
    data["eeq"].sel(e1_over_e2=ratio, method="nearest").plot(
        ax=axes, xscale="log", yscale="log", label=f"E1/E2* about {ratio:g}"
    )
axes.set_title("contact stiffness S / (2 a E2*)")
axes.legend()

# %% [markdown]
# ## As a contact
#
# The table answers like the embedded one; compare it with a direct solve.

# %%
system = System(
    sphere_radius=1e-3,
    sphere_modulus=2e6,
    film=Elastic(young_modulus=3.5e6, poisson_ratio=0.5),
    film_thickness=1e-5,
    substrate=Elastic(young_modulus=np.inf, poisson_ratio=0.25),
)
a = 6.5e-5
exact = solve(a / 1e-5, 1.75, 0.5, np.inf, tolerance=1e-12)
for name, used in {"own": Table.read(path), "embedded": Table.embedded()}.items():
    stiffness = used.contact(system).stiffness(a)
    print(name, f"{stiffness / (2 * a * 2e6 * exact.eeq) - 1:.1e}")
folder.cleanup()

# %% [markdown]
# ## Of a stack of layers
#
# A table of one stack serves spheres of any modulus. The stack goes with the table.

# %%
primer = Elastic(young_modulus=5e5, poisson_ratio=0.5)
stack = Stack(
    base=system.substrate,
    layers=[
        Layer(name="primer", material=primer, thickness=2.5e-6),
        Layer(name="elastomer", material=system.film, thickness=7.5e-6),
    ],
)
on_stack = generate(
    {
        "title": "An elastomer on a primer",
        "tolerance": 1e-5,
        "a_over_t": {"from": 0.1, "to": 20},
        "e1_over_e2": {"from": 0.1, "to": 10},
        "stack": stack,
    },
    progress=False,
)
for modulus in (1e6, 2e6, 2e7):
    lens = StackSystem(stack=on_stack.stack, sphere_radius=1e-3, sphere_modulus=modulus)
    load = on_stack.contact(lens).pull_off(0.04).load
    print(f"E2* = {modulus:.0e} Pa: pull-off at {load:.3e} N")
