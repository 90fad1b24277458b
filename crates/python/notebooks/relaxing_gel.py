# %% [markdown]
# # A gel that relaxes
#
# A sphere of radius 10 µm is pressed into a gel of 5 µm on glass, held, and pulled back. The
# modulus of the gel falls in time by a power law. The contact at any time follows from the elastic
# contact on the same film, exactly, at every thickness.

# %%
import matplotlib.pyplot as plt
import numpy as np

from coated_contact import Elastic, Relaxation, System, Table

law = Relaxation.power_law(exponent=0.2, time=1.0)


def gel(thickness):
    """Return the contact on a gel of 1 kPa (after 1 s) between rigid bodies."""
    system = System(
        sphere_radius=1e-5,
        sphere_modulus=float("inf"),
        film=Elastic(young_modulus=1e3, poisson_ratio=0.5),
        film_thickness=thickness,
        substrate=Elastic(young_modulus=float("inf"), poisson_ratio=0.25),
    )
    return Table.embedded().contact(system)


# %% [markdown]
# ## Approach, hold and retract
#
# `error` is the estimated error in parts of the largest load; that of the table adds.

# %%
times = np.linspace(0, 2.5, 251)
program = {"time": [0, 1, 1.5, 2.5], "penetration": [0, 5e-7, 5e-7, 0]}
out = gel(5e-6).history(**program, relaxation=law, at=times)
print(f"error {out.error:.0e}; separated after {out.time[out.phase == 'separated'][1]:.2f} s")
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
out.plot(left)
right.plot(1e9 * out.penetration, 1e9 * out.load)
right.set_xlabel("penetration (nm)")
right.set_ylabel("load (nN)")

# %% [markdown]
# ## Creep under a load
#
# The load grows in 0.1 s and is held. The contact grows by the creep compliance of the law; on a
# thin film the penetration grows less than in proportion.

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
late = np.geomspace(0.1, 100, 40)
for thickness in (1e-4, 5e-6, 1e-6):
    crept = gel(thickness).history([0, 0.1], law, load=[0, 2e-9], at=late)
    axes.loglog(late, crept.penetration, label=f"{1e6 * thickness:g} µm")
axes.set_xlabel("time (s)")
axes.set_ylabel("penetration (m)")
axes.legend(title="thickness")

# %% [markdown]
# ## Law of the material, or flow of the solvent?
#
# A gel also relaxes because its solvent flows. That takes a time that grows like the square of the
# contact radius, and is no law of the material. Hold at two penetrations: the load of a material
# that relaxes falls by the same factor in the same time at both.

# %%
for depth in (2e-7, 1e-6):
    held = gel(5e-6).history([0, 0.01], law, penetration=[0, depth], at=[0.1, 10.0])
    radius, factor = held.contact_radius[0], held.load[1] / held.load[0]
    print(f"contact radius {1e6 * radius:.2f} µm: the load falls to {100 * factor:.1f} %")
