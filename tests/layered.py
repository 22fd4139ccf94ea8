"""Shipped exercises with their tissue in layers: for tests of what is not the patient."""

from app.exercises.library import load_exercise
from app.exercises.schema import Exercise
from app.exercises.tissue import in_layers

_ALONG = {"puncture", "cutting", "relaxation", "bone_contact"}


def layered(name: str) -> Exercise:
    """Return a shipped exercise that holds, drags and rubs the needle, and needs no field."""
    exercise = in_layers(load_exercise(name))
    effects = {
        effect: part.model_copy(update={} if effect == "breathing" else {"model": ""})
        for effect, part in exercise.effects.items()
        if effect not in _ALONG
    }
    return exercise.model_copy(update={"effects": effects})
