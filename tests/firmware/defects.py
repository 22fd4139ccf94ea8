"""What a board can get wrong: one line of docs/protocol.md each, and how it is broken.

The table was written from the page alone, before the checks of `acus device conform`: its lines are
not made to fit them.
"""

import shutil
from dataclasses import dataclass

import yaml
from firmware_rig import FIRMWARE, ROOT

EDITS = ROOT / "tests" / "firmware" / "defects.yaml"


@dataclass(frozen=True, slots=True)
class Defect:
    """A mistake that a firmware's author can make, by its name.

    Attributes:
        name: of the defect.
        rule: words of docs/protocol.md that it breaks.
        what: the mistake.
    """

    name: str
    rule: str
    what: str


DEFECTS = (
    Defect("crc-unchecked", "A wrong CRC", "damaged frames are obeyed"),
    Defect("never-in-step", "in step again one frame after", "an overlong frame is never over"),
    Defect("long-command", "other length than below is ignored", "13 bytes count as a COMMAND"),
    Defect("unknown-answered", "message of unknown type", "an unknown type is answered"),
    Defect("zero-in-sequence", "the bytes are cut at each zero", "two zeros together become one"),
    Defect("one-frame-a-read", "Every valid command is answered", "of two frames one is obeyed"),
    Defect("hello-keeps-motors", "The board stops its motors", "HELLO leaves the motors on"),
    Defect("hello-keeps-error", "clears its error", "HELLO leaves the error"),
    Defect("hello-of-any-version", "HELLO of the board's own version", "any version greets it"),
    Defect("silent-to-others", "same in every version", "another version gets no INFO"),
    Defect("boot-each-hello", "another one after each start", "each HELLO is a new power cycle"),
    Defect("serial-not-padded", "ASCII, padded with zeros", "rubbish follows the serial number"),
    Defect("sequence-before", "sequence number of the command that this answers", "one less"),
    Defect("sequence-of-8-bits", "65535 is followed by 0", "the high byte is lost"),
    Defect("time-in-ms", "time since power-up, modulo", "the time is in milliseconds"),
    Defect("counts-of-16-bits", "i32 | counts | left joint", "the timer's 16 bits, not widened"),
    Defect("only-left-finite", "A torque that is not finite", "only the left is looked at"),
    Defect("infinity-is-large", "A torque that is not finite", "infinity is limited, not reported"),
    Defect("error-1-stays", "1 ends with the next good command", "it stays until HELLO"),
    Defect("error-2-ends", "2 with the next HOME that is obeyed", "a good command ends it"),
    Defect("home-while-enabled", "while enabled", "HOME is obeyed while enabled"),
    Defect("home-of-any-cycle", "number of the power cycle is not the present", "any number homes"),
    Defect("home-keeps-counts", "the counters begin at zero here", "only the flag is set"),
    Defect("watchdog-30-ms", "torque zero no later than", "it trips after 30 ms"),
    Defect("watchdog-by-any-byte", "after the last valid COMMAND", "any byte restarts it"),
    Defect("watchdog-only-says", "torque zero no later than", "it sets its flag, no torque to 0"),
    Defect("tripped-forgotten", "The next valid command with enable", "any command ends it"),
    Defect("any-flag-enables", "bit 0 enable", "any flag enables"),
    Defect("answered-twice", "with a STATE, at once", "each STATE is sent twice"),
    Defect("answered-late", "with a STATE, at once", "a STATE goes out with the next"),
    Defect("speaks-unasked", "nothing else is sent unasked", "a STATE every 50 ms"),
    Defect("no-limit", "scaled down together if one exceeds", "torques are not limited"),
    Defect("limits-each", "Both torques are scaled down together", "each is limited by itself"),
    Defect("motor-reversed", "torques turn the joint the same way", "the left motor turns back"),
    Defect("encoders-swapped", "*left* is the joint at negative x", "left and right are swapped"),
)


def plant(defect, folder):
    """Copy the firmware to a folder, make the mistake in it; return where it is."""
    broken = folder / defect.name
    shutil.copytree(FIRMWARE, broken)
    for edit in yaml.safe_load(EDITS.read_text(encoding="utf-8"))[defect.name]:
        path = broken / edit["file"]
        text = path.read_text(encoding="utf-8")
        assert text.count(edit["text"]) == 1, (defect.name, edit["text"])
        path.write_text(text.replace(edit["text"], edit["instead"]), encoding="utf-8")
    return broken
