"""Tables of parameters of public functions, classes and methods, in place of the list of fields of ``help``."""

import ballscrew
import parameter_tables


def _append(app, what, name, _value, _options, lines):
    package, _, short = name.partition(".")
    known = short in ballscrew.__all__ or short in parameter_tables.methods()
    if what not in ("function", "class", "exception", "method") or package != "ballscrew" or not known:
        return
    for read in (parameter_tables.MEANINGS, parameter_tables.__file__):
        app.env.note_dependency(str(read))
    if "Fields:" in lines:
        first = lines.index("Fields:")
        last = lines.index("Computed:", first) if "Computed:" in lines[first:] else len(lines)
        lines[first:last] = []
    at = lines.index("Computed:") if "Computed:" in lines else len(lines)
    lines[at:at] = parameter_tables.lines_of(short)


def setup(app):
    app.connect("autodoc-process-docstring", _append, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
