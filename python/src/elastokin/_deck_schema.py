"""The keys of a deck from `elastokin schema`, and their descriptions, for editors."""

from __future__ import annotations

from typing import Any

from ._deck_text import Record


class Key:
    """A key of a group: a row of the schema."""

    def __init__(self, name: str, row: dict[str, Any], is_required: bool, units: dict[str, str]) -> None:
        self.name, self.is_required, self.units = name, is_required, units
        self.about: str = row.get("description", "")
        self.default: Any = row.get("default")
        self.unit: str = row.get("x-unit", "")
        self.names: str = row.get("x-names", "")
        self.built_in: list[str] = row.get("examples", [])
        one = row["anyOf"][0] if "anyOf" in row else row
        many = row["anyOf"][1] if "anyOf" in row else row
        self.least: int = one.get("minItems", 1)
        self.most: int = many.get("maxItems", 1)
        self.value: dict[str, Any] = one.get("items", one)
        self.accepted: list[str] = self.value.get("enum", [])
        self.is_text = self.value["type"] == "string"
        self.is_switch = self.value["type"] == "boolean"

    def literal(self, value: Any) -> str:
        """A value as written in a deck."""
        if isinstance(value, list):
            return ", ".join(self.literal(one) for one in value)
        if isinstance(value, bool):
            return ".true." if value else ".false."
        return f"'{value}'" if isinstance(value, str) else str(value)

    def unit_in(self, model: Record | None) -> str:
        """The unit in the units of the deck: N/mm for force/length. A unit that depends on another part is described."""
        if self.unit in _DEPENDENT:
            return _DEPENDENT[self.unit]
        parts = self.unit.replace("*", " * ").replace("/", " / ").split()
        words = [(model and model.value(part)) or self.units.get(part, part) for part in parts]
        return "".join(words).replace("*", " ")

    def values_text(self) -> str:
        """Number and kind of the values: '3 numbers, at least 0'."""
        count = str(self.least) if self.least == self.most else f"{self.least} to {self.most}"
        kind = {"string": "string", "number": "number", "integer": "integer", "boolean": "switch"}[self.value["type"]]
        text = f"{count} {kind}{'' if self.most == 1 else ('es' if kind == 'switch' else 's')}"
        for word, label in (("minimum", "at least"), ("exclusiveMinimum", "greater than"), ("maximum", "at most")):
            if word in self.value:
                text += f", {label} {self.value[word]}"
        return text + (", not 0" if "not" in self.value else "")

    def text(self, group: str, model: Record | None) -> str:
        """Meaning, values, unit and default in Markdown."""
        lines = [f"**{self.name}** of `&{group}`{' (required)' if self.is_required else ''}: {self.about}", ""]
        lines.append(f"- {self.values_text()}")
        if self.unit:
            lines.append(f"- unit: {self.unit_in(model)}")
        if self.default is not None:
            lines.append(f"- default: `{self.literal(self.default)}`")
        if self.accepted:
            lines.append("- accepted: " + ", ".join(f"`{word}`" for word in self.accepted))
        if self.names:
            also = "".join(f", or `{word}`" for word in self.built_in)
            lines.append(f"- name of a `&{self.names}`{also}")
        return "\n".join(lines)


_DEPENDENT = {
    "deflection": "length or angle, as the measure, driver or element",
    "reaction": "force or moment, as the measure, driver or element",
    "reaction/deflection": "force or moment per length or angle, as the measure, driver or element",
    "swept": "unit of the swept value",
}


class Schema:
    """All groups and keys of a deck."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.about: dict[str, str] = {}
        self.keys: dict[str, dict[str, Key]] = {}
        model = data["$defs"]["model"]["properties"]
        units = {key: str(model[key]["default"]) for key in ("length", "force", "angle", "mass")}
        for group, reference in data["properties"].items():
            row = data["$defs"][(reference.get("items") or reference)["$ref"].rpartition("/")[2]]
            required = row.get("required", [])
            self.about[group] = row["description"]
            self.keys[group] = {key: Key(key, one, key in required, units) for key, one in row["properties"].items()}

    def key(self, group: str, name: str) -> Key | None:
        """A key of a group; None if there is no such key."""
        return self.keys.get(group, {}).get(name)
