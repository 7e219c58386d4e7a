"""The table of parameters of each public function and class, in place of the list of fields that ``help`` shows."""

import ballscrew
import parameter_tables


def _append(_app, what, name, _value, _options, lines):
    package, _, short = name.partition(".")
    if what not in ("function", "class", "exception") or package != "ballscrew" or short not in ballscrew.__all__:
        return
    if "Fields:" in lines:
        first = lines.index("Fields:")
        last = lines.index("Computed:", first) if "Computed:" in lines[first:] else len(lines)
        lines[first:last] = []
    at = lines.index("Computed:") if "Computed:" in lines else len(lines)
    lines[at:at] = parameter_tables.lines_of(short)


def setup(app):
    app.connect("autodoc-process-docstring", _append, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
