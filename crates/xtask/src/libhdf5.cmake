# libhdf5 is compiled without optimisation. That takes half of the time, and a table of some megabytes is
# written as fast.
set(CMAKE_C_FLAGS_MINSIZEREL "-O0 -DNDEBUG" CACHE STRING "flags of the build type of this workspace")
