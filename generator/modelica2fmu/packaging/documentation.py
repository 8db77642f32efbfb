"""The page documentation/index.html of an FMU."""

from __future__ import annotations

from html import escape

from modelica2fmu.description.model_description import Causality, ModelDescription, Variable
from modelica2fmu.packaging.description_xml import generation_tool, number
from modelica2fmu.packaging.solver_variables import PREFIX
from modelica2fmu.packaging.toolchain import COMPILE_OPTIONS

_STYLE = "body{font-family:sans-serif;max-width:60em;margin:2em auto}td,th{text-align:left;padding:.1em .8em}"


def _table(title: str, variables: list[Variable]) -> str:
    if not variables:
        return ""
    rows = "".join(
        f"<tr><td><code>{escape(variable.name)}</code></td>"
        f"<td>{'' if variable.start is None else escape(str(variable.start))}</td>"
        f"<td>{escape(variable.unit)}</td><td>{escape(variable.description)}</td></tr>\n"
        for variable in variables
    )
    head = "<tr><th>Name</th><th>Start</th><th>Unit</th><th>Meaning</th></tr>\n"
    return f"<h2>{title}</h2>\n<table>\n{head}{rows}</table>\n"


def documentation_page(description: ModelDescription) -> str:
    """A page with what a user of the FMU sets and reads, the integrator's options, and how it was compiled.

    Args:
        description: the model, the integrator's variables included.
    """

    def chosen(*causalities: Causality) -> list[Variable]:
        return [v for v in description.variables if v.causality in causalities and not v.name.startswith(PREFIX)]

    experiment = description.experiment
    times = ", ".join(
        f"{name} {number(value)}{unit}"
        for name, value, unit in (
            ("start", experiment.start, " s"),
            ("stop", experiment.stop, " s"),
            ("tolerance", experiment.tolerance, ""),
            ("interval", experiment.interval, " s"),
        )
        if value is not None
    )
    return (
        "<!DOCTYPE html>\n"
        f'<html lang="en"><head><meta charset="utf-8"><title>{escape(description.name)}</title>'
        f"<style>{_STYLE}</style></head><body>\n"
        f"<h1>{escape(description.name)}</h1>\n<p>{escape(description.description)}</p>\n"
        f"<p>{len(description.states)} continuous states, {description.indicator_count} event indicators."
        f"{' Default experiment: ' + times + '.' if times else ''} Made by {escape(generation_tool())}.</p>\n"
        + _table("Inputs", chosen(Causality.INPUT))
        + _table("Outputs", chosen(Causality.OUTPUT))
        + _table("Parameters", chosen(Causality.PARAMETER))
        + _table("Integrator of co-simulation", [v for v in description.variables if v.name.startswith(PREFIX)])
        + "<h2>Sources</h2>\n<p>The folder <code>sources</code> holds all C of the FMU. It was compiled with gcc "
        f"<code>{escape(' '.join(COMPILE_OPTIONS))}</code>; <code>sources/CMakeLists.txt</code> does it again where "
        "CVODE of SUNDIALS 6 and the model's external libraries are installed.</p>\n"
        "</body></html>\n"
    )
