"""The page engine's texts made quicker: what follows from a style is found once for it, and a text that fits into a line is set once.

As in ``quick_engine``, each function gives what its original gives, and asks it wherever a case is not plain.
"""

from __future__ import annotations

from copy import copy
from typing import Any

from diecut_report.report.surroundings import no_compiler

with no_compiler():
    from weasyprint.text import line_break
    from weasyprint.text.ffi import ffi, gobject, pango

_slow_setup = line_break.Layout.setup


def begin_layout(layout: Any, style: Any) -> None:
    """Begin a layout of text by what is known of its style."""
    if style["text_decoration_line"] != "none":
        _slow_setup(layout, style)
        return
    kept = style.__dict__
    if "text_setting" not in kept:
        kept["text_setting"] = _text_setting(style)
    context, layout.language, description, features = kept["text_setting"]
    layout.style, layout.first_line_direction = style, 0
    layout.layout = ffi.gc(pango.pango_layout_new(context), gobject.g_object_unref)
    pango.pango_layout_set_auto_dir(layout.layout, False)
    pango.pango_layout_set_font_description(layout.layout, description)
    layout.ascent = layout.underline_position = layout.strikethrough_position = None
    if features:
        attributes = ffi.gc(pango.pango_attr_list_new(), pango.pango_attr_list_unref)
        pango.pango_attr_list_insert(attributes, pango.pango_attr_font_features_new(features))
        pango.pango_layout_set_attributes(layout.layout, attributes)


def _text_setting(style: Any) -> tuple[Any, Any, Any, bytes]:
    """Return the context of a style's texts, their language, font and features."""
    context = ffi.gc(pango.pango_font_map_create_context(style.font_config.font_map), gobject.g_object_unref)
    pango.pango_context_set_round_glyph_positions(context, False)
    pango.pango_context_set_base_dir(context, line_break.PANGO_DIRECTION[style["direction"]])
    language = pango.pango_language_get_default()
    override = style["font_language_override"]
    name = line_break.LST_TO_ISO.get(override.lower(), override) if override != "normal" else style["lang"]
    if name:
        letters, _ = line_break.unicode_to_char_p(name)
        language = pango.pango_language_from_string(letters)
        pango.pango_context_set_language(context, language)
    asked = ("kerning", "ligatures", "position", "caps", "numeric", "alternates", "east_asian")
    variants = [style[f"font_{'' if name == 'kerning' else 'variant_'}{name}"] for name in asked]
    features = line_break.font_features(*variants, style["font_feature_settings"])
    told = ",".join(f"{key} {value}" for key, value in features.items()).encode()
    return context, language, line_break.get_font_description(style), told


_strut = line_break.strut


def line_height(style: Any) -> Any:
    """Return the height of a line and its baseline, which a style alone gives."""
    kept = style.__dict__
    if "strut" not in kept:
        kept["strut"] = _strut(style)
    return kept["strut"]


_split = line_break.split_first_line


def whole_line(
    text: str, style: Any, context: Any, max_width: float | None, justification_spacing: float,
    is_line_start: bool = True, minimum: bool = False,
) -> Any:  # fmt: skip
    """Return a line of text as it was set before, where all of it has room."""
    known = style.__dict__.setdefault("whole_lines", {})
    found = known.get(text)
    if found is not None and (max_width is None or found[3] <= max_width):
        layout = copy(found[0])
        layout.max_width, layout.justification_spacing = max_width, justification_spacing
        return (layout, *found[1:])
    made = _split(text, style, context, max_width, justification_spacing, is_line_start, minimum)
    if made[2] is None and (max_width is None or made[3] <= max_width):
        known[text] = (copy(made[0]), *made[1:])
    return made
