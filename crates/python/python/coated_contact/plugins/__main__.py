"""Print the paths of the models for nanite and PyJibe."""

from . import APPROACH, RETRACT

print(APPROACH)
print(RETRACT)
