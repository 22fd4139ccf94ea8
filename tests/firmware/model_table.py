"""The C program's table of states in SPIN's language: run it to write it anew."""

from firmware_rig import EVENTS, FIRMWARE, STATES, Bench

TABLE = FIRMWARE / "model" / "table.pml"


def table(board):
    """Write the transitions of `state_after` in Promela; what leads nowhere is left out."""
    lines = ["/* written from core/states.c by a test's rig; do not edit */"]
    lines += [f"#define {name} {k}" for names in (STATES, EVENTS) for k, name in enumerate(names)]
    lines += ["", "inline NEXT(s, e)", "{", "    if"]
    for k, state in enumerate(STATES):
        for event, name in enumerate(EVENTS):
            after = STATES[board.lib.state_after(k, event)]
            if after != state:
                lines.append(f"    :: s == {state} && e == {name} -> s = {after}")
    return "\n".join([*lines, "    :: else", "    fi", "}", ""])


if __name__ == "__main__":
    TABLE.write_text(table(Bench()), encoding="utf-8")
