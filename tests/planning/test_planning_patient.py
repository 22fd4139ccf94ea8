"""How a patient is opened: what it waits for is said."""

import pytest

from app.core.progress import Progress
from app.planning import patient


@pytest.mark.long("statistics")
def test_what_a_patient_waits_for_last_is_said_before_it_is_waited_for(monkeypatch):
    said = []
    monkeypatch.setattr(patient, "_load_verdict", lambda: said.append("waited"))
    patient.load_phantom(1, Progress(lambda share, text: said.append((share, text))))
    assert said[-1] == "waited"
    share, text = said[-2]
    assert share < 1.0
    assert "first start compiles" in text
