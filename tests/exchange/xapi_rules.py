"""Rules of xAPI 1.0.3 for a statement (xAPI-Data.md of ADL), as a checker of its own.

Of each the section is named. 2.2: no property that the specification does not name, no null, no
empty object; 2.4.1: the id is a UUID; 2.4.2.1, 2.4.2.4: an Agent has one inverse functional
identifier, an account has homePage (IRL) and name; 2.4.3: a verb's id is an IRI, its display a
language map; 2.4.4.1: an activity's id is an IRI; 2.4.5: types of the result, scaled within -1 and
1, raw between min and max; 2.4.6: names of the context; 4.2: RFC 5646; 4.5: ISO 8601 to the
millisecond at least, with a time zone; 4.6: ISO 8601 4.4.3.2, 0.01 s at most.
"""

import re
from datetime import datetime
from urllib.parse import urlsplit
from uuid import UUID

STATEMENT = {
    *("id", "actor", "verb", "object", "result", "context", "timestamp", "stored"),
    *("authority", "version", "attachments"),
}
CONTEXT = {
    *("registration", "instructor", "team", "contextActivities", "revision", "platform"),
    *("language", "statement", "extensions"),
}
DEFINITION = {"name", "description", "type", "moreInfo", "extensions"}
DURATION = re.compile(
    r"P(?=[0-9T])(\d+Y)?(\d+M)?(\d+D)?(T(?=\d)(\d+H)?(\d+M)?(\d+(\.\d{1,2})?S)?)?|P\d+W"
)
LANGUAGE = re.compile(r"[a-z]{2,3}(-[A-Z][a-z]{3})?(-([A-Z]{2}|\d{3}))?")
TIMESTAMP = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3,}(Z|[+-]\d\d:\d\d)")


CMI5 = "http://adlnet.gov/expapi/verbs/"
MASTERY = "https://w3id.org/xapi/cmi5/context/extensions/masteryscore"


def broken_rules(statement):
    """One line for each rule that a statement breaks."""
    return list(_statement(statement))


def broken_cmi5_rules(statement):
    """One line for each rule of cmi5 (cmi5_spec.md of AICC, quartz) that a result breaks.

    9.5.1: a score with passed and failed alone, scaled in 0 ... 1, raw, min and max integers, the
    verb consistent with masteryScore; 9.5.2: success true, false with these, absent else; 9.5.3:
    completion true with completed, absent else; 9.5.4.1: a duration; 9.6.3.2: masteryScore in
    0 ... 1 with four decimals at most; 9.7: a timestamp in UTC.
    """
    return list(_cmi5(statement))


def _cmi5(s):
    verb, result = s["verb"]["id"].removeprefix(CMI5), s.get("result", {})
    judged = {"passed": True, "failed": False}
    if verb not in (*judged, "completed"):
        yield f"9.3: {verb}"
    if result.get("success") is not judged.get(verb):
        yield "9.5.2: success"
    if result.get("completion") is not (True if verb == "completed" else None):
        yield "9.5.3: completion"
    if "duration" not in result:
        yield "9.5.4.1: duration"
    score = result.get("score")
    mark = s["context"].get("extensions", {}).get(MASTERY)
    if mark is not None and not (0 <= mark <= 1 and round(mark, 4) == mark):
        yield f"9.6.3.2: {mark}"
    if score is not None:
        if verb not in judged:
            yield "9.5.1: a score"
        if not 0 <= score["scaled"] <= 1 or any(
            type(score[name]) is not int for name in ("raw", "min", "max")
        ):
            yield f"9.5.1: {score}"
        if mark is not None and (score["scaled"] >= mark) is not judged.get(verb):
            yield "9.5.1: masteryScore"
    if not s.get("timestamp", "").endswith("Z"):
        yield "9.7: timestamp"


def _statement(s):
    yield from _whole(s)
    yield from _only(s, STATEMENT, "statement")
    yield from (f"2.2: no {name}" for name in ("actor", "verb", "object") if name not in s)
    if str(UUID(s["id"])) != s["id"]:
        yield "2.4.1: id"
    yield from _agent(s["actor"])
    yield from _only(s["verb"], {"id", "display"}, "verb")
    yield from _iri(s["verb"]["id"], "2.4.3")
    yield from _language_map(s["verb"]["display"])
    if s["object"].get("objectType") == "StatementRef":  # 2.3.2: what it voids, by its id
        yield from _only(s["object"], {"objectType", "id"}, "object")
        if str(UUID(s["object"]["id"])) != s["object"]["id"]:
            yield "2.4.4.3: id"
    else:
        yield from _activity(s["object"])
    yield from _result(s.get("result", {}))
    context = s.get("context", {})
    yield from _only(context, CONTEXT, "context")
    if not isinstance(context.get("platform", ""), str):
        yield "2.4.6: platform"
    for kind, activities in context.get("contextActivities", {}).items():
        if kind not in ("parent", "grouping", "category", "other") or type(activities) is not list:
            yield "2.4.6.2: contextActivities"
        for activity in activities:
            yield from _activity(activity)
    if "timestamp" in s:
        if not TIMESTAMP.fullmatch(s["timestamp"]):
            yield f"4.5: {s['timestamp']}"
        datetime.fromisoformat(s["timestamp"])


def _whole(value):
    if value is None or value == {}:
        yield f"2.2: {value}"
    parts = value.values() if isinstance(value, dict) else value if type(value) is list else ()
    for part in parts:
        yield from _whole(part)


def _only(value, names, where):
    yield from (f"2.2: {name} in {where}" for name in value if name not in names)


def _agent(actor):
    identifying = {"mbox", "mbox_sha1sum", "openid", "account"}
    yield from _only(actor, {"objectType", "name", *identifying}, "actor")
    if len(identifying & set(actor)) != 1 or actor.get("objectType", "Agent") != "Agent":
        yield "2.4.2.1: one inverse functional identifier"
    if "account" in actor:
        if set(actor["account"]) != {"homePage", "name"} or not actor["account"]["name"]:
            yield "2.4.2.4: account"
        yield from _iri(actor["account"]["homePage"], "2.4.2.4")


def _activity(activity):
    yield from _only(activity, {"objectType", "id", "definition"}, "activity")
    yield from _iri(activity["id"], "2.4.4.1")
    definition = activity.get("definition", {})
    yield from _only(definition, DEFINITION, "definition")
    for name in ("name", "description"):
        yield from _language_map(definition.get(name, {}))
    if "type" in definition:
        yield from _iri(definition["type"], "2.4.4.1")


def _result(result):
    names = {"score", "success", "completion", "response", "duration", "extensions"}
    yield from _only(result, names, "result")
    for name in ("success", "completion"):
        if not isinstance(result.get(name, True), bool):
            yield f"2.4.5: {name}"
    if "duration" in result and not DURATION.fullmatch(result["duration"]):
        yield f"4.6: {result['duration']}"
    score = result.get("score", {"scaled": 0, "min": 0, "raw": 0, "max": 1})
    yield from _only(score, {"scaled", "raw", "min", "max"}, "score")
    if any(isinstance(v, bool) or not isinstance(v, int | float) for v in score.values()):
        yield "2.4.5.1: numbers"
    if not (-1 <= score["scaled"] <= 1 and score["min"] <= score["raw"] <= score["max"]):
        yield f"2.4.5.1: {score}"


def _iri(text, section):
    parts = urlsplit(text)
    if not parts.scheme or not parts.netloc or re.search(r"[\s<>\"{}|\\^`]", text):
        yield f"{section}: {text!r} is no IRI"


def _language_map(words):
    for tag, text in words.items():
        if not LANGUAGE.fullmatch(tag) or not isinstance(text, str):
            yield f"4.2: {tag}"
