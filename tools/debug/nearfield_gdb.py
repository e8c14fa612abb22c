"""Pretty printers of nearfield for gdb.

    (gdb) source nearfield_gdb.py

Handles show what they name, a Status its code, message and reasons, an Expected its value or its
error. Message and reasons are shown where the library was compiled with debug information.
"""

import gdb
import gdb.printing

NO_INDEX = 0xFFFFFFFF


class Vector2:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return f"({float(self.value['x']):g}, {float(self.value['y']):g})"


class ShapeHandle:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        index = int(self.value["index"])
        if index == NO_INDEX:
            return "no shape"
        return f"shape {index}, generation {int(self.value['generation'])}"


class QueryHandle:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        index = int(self.value["index"])
        kind = self.value.type.strip_typedefs().template_argument(0).name.split("::")[-1]
        return f"no {kind}" if index == NO_INDEX else f"{kind} {index} of its batch"


class Ticket:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        number = int(self.value["number"])
        return f"ticket {number}" if number else "no ticket"


class Feature:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return f"{last_name(self.value['kind'])} {int(self.value['index'])}"


class Status:
    def __init__(self, value):
        self.value = value
        words = value["words_"]["_M_ptr"]
        try:
            self.words = words.dereference() if int(words) else None
            if self.words is not None:
                self.words["message"]
        except gdb.error:  # Words is known only where the library has debug information
            self.words = None

    def to_string(self):
        code = last_name(self.value["code_"])
        if self.words is None:
            return code
        return f"{code}: {self.words['message'].format_string()}"

    def children(self):
        if self.words is not None:
            printer = gdb.default_visualizer(self.words["reasons"])
            if printer is not None:
                for number, reason in enumerate(printer.children()):
                    yield f"reason {number}", reason[1]


class Expected:
    def __init__(self, value):
        self.value = value
        self.has_value = bool(value["value_"]["_M_payload"]["_M_engaged"])

    def to_string(self):
        return "value" if self.has_value else "error"

    def children(self):
        if self.has_value:
            yield "value", self.value["value_"]["_M_payload"]["_M_payload"]["_M_value"]
        else:
            yield "error", self.value["error_"]


def last_name(enumerator):
    return str(enumerator).split("::")[-1]


def register(objfile=None):
    printers = gdb.printing.RegexpCollectionPrettyPrinter("nearfield")
    for printer in (Vector2, ShapeHandle, Ticket, Feature, Status):
        printers.add_printer(printer.__name__, f"^nearfield::{printer.__name__}$", printer)
    for printer in (QueryHandle, Expected):
        printers.add_printer(printer.__name__, f"^nearfield::{printer.__name__}<.*>$", printer)
    gdb.printing.register_pretty_printer(objfile, printers, replace=True)


register()
