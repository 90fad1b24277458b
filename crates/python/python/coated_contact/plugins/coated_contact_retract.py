"""A sphere on a film on a substrate: the retract, as a model of nanite and PyJibe."""

from coated_contact.plugins import PARAMETERS, Plugin

_plugin = Plugin(retract=True)

model_doc = """A sphere on a film bonded to a substrate, with adhesion: the retract.

The force at the penetration ``contact_point - tip position`` in Barthel's model (2007), from the
embedded table of the package coated_contact, to 1e-6. Which points are in contact is read from the
data. Set the tip radius and the film thickness before the fit.
"""
model_key = "coated_contact_retract"
model_name = "sphere on a film (retract)"
parameter_keys = [key for key, *_ in PARAMETERS]
parameter_names = [name for _, name, *_ in PARAMETERS]
parameter_units = [unit for _, _, unit, *_ in PARAMETERS]
parameter_anc_keys = ["work_of_adhesion", "tabor"]
parameter_anc_names = ["Work of Adhesion (from the smallest force)", "Tabor's Parameter"]
parameter_anc_units = ["J/m²", ""]
valid_axes_x = ["tip position"]
valid_axes_y = ["force"]
weight_cp = 0

get_parameter_defaults = _plugin.get_parameter_defaults
model_func = _plugin.model_func
residual = _plugin.residual
compute_ancillaries = _plugin.compute_ancillaries
