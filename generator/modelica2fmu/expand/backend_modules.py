"""The modules that a model's choice of a back end needs.

The contact engine loads FCL, libccd or coal where a scene names it as back end (contact_multibody.h); an FMU brings the
module along that its model chooses, and no other.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from modelica2fmu.expand.scalar_model import ExternalCall

_INTERN: Final = "cmb_modelica_intern"
# Numbers of `cmb_backend`, the last argument of the function.
_MODULES: Final = {
    "2": "libContactMultiBodyLibccd.so",
    "3": "libContactMultiBodyFcl.so",
    "4": "libContactMultiBodyCoal.so",
}


def chosen_modules(calls: Sequence[ExternalCall]) -> tuple[str, ...]:
    """File names of the modules that scenes of the model name, in order of these names, each once."""
    backends = {str(call.args[-1].values[0]) for call in calls if call.symbol == _INTERN}
    return tuple(sorted(_MODULES[backend] for backend in backends if backend in _MODULES))
