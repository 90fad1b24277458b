# %% [markdown]
# # A force map
#
# 24 x 16 curves over a coating whose modulus grows from left to right, on a substrate that is
# stiffer. Each curve is fitted by itself, on all cores.

# %%
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

from coated_contact import Elastic, Experiment, System, fit_map, simulate

glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
rows, columns = 16, 24
true_modulus = np.tile(np.geomspace(1e4, 1e5, columns), rows)


def curve(i):
    system = System(
        sphere_radius=5e-6,
        sphere_modulus=glass.reduced_modulus,
        film=Elastic(young_modulus=true_modulus[i], poisson_ratio=0.45),
        film_thickness=2e-6,
        substrate=glass,
    )
    plan = Experiment(
        kind="load-penetration",
        abscissa=np.linspace(8e-7, -6e-7, 100),
        retract=np.full(100, True),
        system=system,
        work_of_adhesion=1e-3,
    )
    made = simulate(plan, noise=1e-10, seed=i)
    # The fit does not know the modulus.
    film = replace(system.film, young_modulus=3e4)
    return replace(made, system=replace(system, film=film))


curves = [curve(i) for i in range(rows * columns)]

# %% [markdown]
# `errors="nan"` leaves curves without a result empty. With `client=distributed.Client(...)` the
# workers of dask fit the curves; the numbers stay the same.

# %%
found = fit_map(curves, ["film_modulus", "work_of_adhesion", "contact_point"], errors="nan")
found

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.2), layout="constrained")
found.plot("film_modulus", shape=(rows, columns), ax=left)
left.set_title("film modulus")
error = found.params["film_modulus"] / true_modulus - 1
right.plot(100 * error, ".", markersize=3)
right.set_xlabel("curve")
right.set_ylabel("error of the film modulus (%)")

# %% [markdown]
# The standard errors are right if the errors over them have a standard deviation of 1.

# %%
units = (found.params["film_modulus"] - true_modulus) / found.stderr["film_modulus"]
print(f"standard deviation {np.nanstd(units):.2f}, failures {len(found.failures)}")
