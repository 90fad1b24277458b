"""A table of the four quantities by scipy's RegularGridInterpolator, method "cubic".

Prints a line with the versions that it runs with. The first line read names in JSON the nodes (in the coordinates in which
splines are smooth) and a file with what is splined there, and is answered by the seconds that this took, or by null where it needs
more memory than there is. Every further line is a list of batches of points, and is answered by the quantities of each batch and
the seconds that it took.
"""

import json
import resource
import sys
import time

import numpy as np
import scipy
from scipy.interpolate import RegularGridInterpolator

GIBIBYTE = 2**30


def available():
    """The bytes of memory that can be had without swapping."""
    with open("/proc/meminfo") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith("MemAvailable"))


def interpolator(axes, file):
    values = np.fromfile(file).reshape([len(nodes) for nodes in axes] + [-1])
    # An allocation that fails is told from a process that is killed.
    resource.setrlimit(resource.RLIMIT_AS, (max(available() - 2 * GIBIBYTE, GIBIBYTE),) * 2)
    try:
        start = time.perf_counter()
        return RegularGridInterpolator(axes, values, method="cubic"), time.perf_counter() - start
    except MemoryError:
        return None, None


def quantities(spline, points):
    """Columns of a point: the coordinates in the order of the axes, then es, by which pi0, eeq and gamma were divided."""
    values = np.exp(spline(points[:, :4]))
    values[:, :3] *= points[:, 4:]
    return values


def timed(spline, points):
    points = np.array(points)
    start = time.perf_counter()
    values = quantities(spline, points)
    return {"quantities": values.tolist(), "seconds": time.perf_counter() - start}


def main():
    print(f"numpy {np.__version__}, scipy {scipy.__version__}", flush=True)
    spline, seconds = interpolator(**json.loads(sys.stdin.readline()))
    print(json.dumps(seconds), flush=True)
    for line in sys.stdin:
        print(json.dumps([timed(spline, points) for points in json.loads(line)]), flush=True)


main()
