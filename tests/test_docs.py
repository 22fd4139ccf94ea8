"""The pages for people: links, anchors and pictures exist, the site needs no other host."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from app.views.shell.feature_plugins import declared_features
from app.views.shell.features import FEATURES
from app.views.shell.help import HOME, PAGES, anchor

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
ROOTS = ("README.md", "CONTRIBUTING.md", "SECURITY.md")
SOURCES = [*(ROOT / name for name in ROOTS), *sorted(DOCS.rglob("*.md"))]


def prose(file):
    """The page without its blocks of code."""
    return re.sub(r"^```.*?^```", "", file.read_text(encoding="utf-8"), flags=re.DOTALL | re.M)


def anchors(file):
    return {anchor(line.lstrip("# ")) for line in prose(file).splitlines() if line.startswith("#")}


def links(file):
    return re.findall(r"\]\(([^)\s]+)\)", prose(file))


@pytest.mark.parametrize("file", SOURCES, ids=lambda file: str(file.relative_to(ROOT)))
def test_links_anchors_and_pictures_of_a_page_exist(file):
    broken = []
    for link in links(file):
        if re.match(r"[a-z]+:", link):
            continue
        name, _, heading = link.partition("#")
        target = (file.parent / name).resolve() if name else file
        if not target.is_file() or (heading and heading not in anchors(target)):
            broken.append(link)
    assert broken == []


def test_every_picture_is_shown_on_a_page():
    shown = {(file.parent / link).resolve() for file in SOURCES for link in links(file)}
    unseen = [one.name for one in (DOCS / "pictures").glob("*.png") if one.resolve() not in shown]
    assert unseen == []


def test_the_navigation_names_pages_that_there_are_each_once():
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").split("\nnav:")[1]
    entries = re.findall(r"^ +- (\S+\.md)$", text, flags=re.M)  # the build adds what is not named
    assert len(set(entries)) == len(entries) > 20
    assert [page for page in entries if not (DOCS / page).is_file()] == []


def test_every_decision_stands_in_their_list():
    listed = set(links(DOCS / "decisions" / "README.md"))
    assert {file.name for file in (DOCS / "decisions").glob("0*.md")} <= listed


def test_the_architecture_is_told_on_three_pages():
    text = (DOCS / "architecture.md").read_text(encoding="utf-8")
    assert len(text) <= 3 * 3600


def test_prose_is_wrapped():
    long = {
        str(file.relative_to(ROOT)): number
        for file in SOURCES
        for number, line in enumerate(prose(file).splitlines(), 1)
        if len(line) > 150 and not line.startswith("|") and " " in line.strip()[:150].strip("- ")
    }
    assert long == {}


def test_every_feature_has_a_page_of_help_and_it_is_there():
    views = ROOT / "app" / "views"
    features = {one.name for one in views.iterdir() if (one / "__init__.py").is_file()}
    own = {one.__module__.split(".")[2]: one.help for one in FEATURES if one.help}
    assert not set(PAGES) & set(own)
    assert {*PAGES, *own} >= features - {"kit", "shell"}
    for page in (*PAGES.values(), *own.values(), *(one.help for one in declared_features()), HOME):
        name, _, heading = page.partition("#")
        assert not heading or heading in anchors(DOCS / name), page
        assert (DOCS / name).is_file()


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    pytest.importorskip("mkdocs", reason="the extra `docs` is not installed")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "-d", str(folder)]
    nowhere = dict.fromkeys(("http_proxy", "https_proxy"), "http://127.0.0.1:9")
    own = os.environ | nowhere | {"ACUS_DOCS_REFERENCE": "false", "NO_MKDOCS_2_WARNING": "1"}
    done = subprocess.run(command, cwd=ROOT, env=own, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.mark.long("journey")
def test_no_page_of_the_site_takes_anything_from_another_host(site):
    taken = set()
    for file in site.rglob("*.html"):
        text = file.read_text(encoding="utf-8")
        taken |= set(re.findall(r'<(?:script|img|iframe)[^>]*src="?((?:https?:)?//[^">]*)', text))
        taken |= set(re.findall(r'<link[^>]*href="?((?:https?:)?//[^">]*)', text))
        assert 'class="mermaid"' not in text  # the theme would fetch what draws it
    for file in site.rglob("*.css"):
        taken |= set(re.findall(r"(?:@import|url\()\s*[\"']?((?:https?:)?//[^\"')]*)",
                                file.read_text(encoding="utf-8")))  # fmt: skip
    assert taken == set()


@pytest.mark.long("journey")
def test_help_finds_its_pages_and_headings_in_the_site(site):
    for page in (*PAGES.values(), HOME):
        name, _, heading = page.partition("#")
        text = (site / name).with_suffix(".html").read_text(encoding="utf-8")
        assert not heading or f'id="{heading}"' in text, page


@pytest.mark.long("journey")
def test_the_search_works_without_a_server(site):
    assert (site / "search" / "search_index.js").is_file()
    assert "search_in_files.js" in (site / "index.html").read_text(encoding="utf-8")
    assert (site / "search_in_files.js").is_file()


QUESTIONS = {
    "password forgotten": "people.html",
    "PIN of a student": "people.html",
    "the camera does not find the marker": "troubleshooting.html",
    "red marker lost": "tracking.html",
    "what does the score mean": "exercises.html",
    "CT is refused": "reading.html",
    "take names out of a CT": "privacy.html",
    "robot does not answer": "troubleshooting.html",
    "write my own force law": "extending.html",
    "replay an attempt": "sessions.html",
    "how do I move the needle with the mouse": "user-guide.html",
    "keyboard shortcuts": "reading.html",
    "change the language": "user-guide.html",
    "my attempt is void": "troubleshooting.html",
    "make a new exercise": "authoring.html",
    "print the results of a course": "people.html",
    "change the pass mark": "exercises.html",
    "camera is too slow": "cameras.html",
    "install on another computer": "installing.html",
    "add my own command": "extending.html",
}
"""What people ask, and the page that must be among the first three answers."""


@pytest.fixture(scope="module")
def search(site):
    """The site's search: its own index, ranked as lunr does, headings before text."""
    lunr = pytest.importorskip("lunr", reason="the extra `dev` is not installed")
    documents = json.loads((site / "search" / "search_index.json").read_text())["docs"]
    fields = [{"field_name": "title", "boost": 1000}, "text"]
    index = lunr.lunr(ref="location", fields=fields, documents=documents)

    def pages(question):
        places = [answer["ref"].split("#")[0] for answer in index.search(question)]
        return list(dict.fromkeys(places))

    return pages


@pytest.mark.long("journey")
@pytest.mark.parametrize("question", QUESTIONS)
def test_a_question_finds_its_page_among_the_first_three(search, question):
    assert QUESTIONS[question] in search(question)[:3]


@pytest.mark.long("journey")
def test_no_name_of_the_code_answers_a_question(search):
    assert not [page for page in search("RigidTransform frozen array") if "reference/" in page]


@pytest.mark.long("journey")
def test_the_reference_lists_every_room_and_what_others_import_from_it(site):
    text = (site / "reference" / "core.html").read_text(encoding="utf-8")
    assert "RigidTransform" in text
    assert "Latest" in text
    rooms = {one.parent.name for one in (ROOT / "app").glob("*/__init__.py")} - {"commands"}
    assert {one.stem for one in (site / "reference").glob("*.html")} == rooms | {"index"}


def test_the_desktop_entry_starts_the_program_and_names_its_icon():
    text = (ROOT / "resources" / "acus.desktop").read_text(encoding="utf-8")
    entry = dict(line.split("=", 1) for line in text.splitlines() if "=" in line)
    assert (entry["Exec"], entry["Icon"], entry["Type"]) == ("acus run", "acus", "Application")
    assert (ROOT / "resources" / "icons" / "acus.svg").is_file()
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert "share/applications/acus.desktop" in project
    assert "share/icons/hicolor/scalable/apps/acus.svg" in project


def test_no_file_of_the_build_names_a_host_to_install_from():
    for name in (
        "pyproject.toml",
        "constraints.txt",
        "Makefile",
        "mkdocs.yml",
        "tools/install-system",
    ):
        text = (ROOT / name).read_text(encoding="utf-8")
        assert not re.search(r"index-url|://", text), name
