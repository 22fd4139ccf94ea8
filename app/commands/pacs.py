"""`acus pacs`: ask a PACS, find, take a series into the library; send it objects of attempts."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer, Commands
from app.commands.ct import MASK_HELP, Mend, RemedyGroup
from app.commands.reader_language import template
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.imaging.library import Imported
    from app.imaging.pacs.query import FoundSeries
    from app.imaging.pacs.settings import PacsSettings

app = Commands(help="A PACS: find series, take them in, send results.", cls=RemedyGroup)

Server = Annotated[
    str | None, typer.Option("--pacs", metavar="NAME", help="Which, where several are configured.")
]
StudyUid = Annotated[str, typer.Argument(metavar="STUDY", help="StudyInstanceUID, of `find`.")]
Mask = Annotated[
    list[str] | None, typer.Option(metavar="COL,ROW,WIDTH,HEIGHT[,PICTURE]", help=MASK_HELP)
]
SeriesUid = Annotated[str, typer.Argument(metavar="SERIES", help="SeriesInstanceUID, of `find`.")]


PASSWORD = "ACUS_DICOMWEB_PASSWORD"
_WAYS = {"get": "C-GET", "move": "C-MOVE", "web": "DICOMweb"}
RANK = 50


def register(root: typer.Typer) -> None:
    """Add `pacs` to the command line."""
    root.add_typer(app, name="pacs")


@app.command("list")
def list_servers() -> Answer:
    """List the configured PACS."""
    from app.imaging.pacs.settings import configured, pacs_path

    servers = configured()
    lines = [
        f"{one.name}  {one.title} at {one.host}:{one.port}, as {one.own_title}, "
        f"{_WAYS[one.retrieve]}, waits {one.timeout_s:g} s{', TLS' if one.tls else ''}"
        for one in servers
    ]
    facts = {"servers": [one.shown() for one in servers]}
    none = sentence("none; `acus pacs add NAME` writes {file}", file=pacs_path())
    return Answer(facts, lines or [none])


@app.command()
def add(
    name: Annotated[str, typer.Argument(help="What to call it here.")],
    host: Annotated[str, typer.Option(help="Name or address.")] = "",
    title: Annotated[str, typer.Option(help="Its AE title.")] = "",
    port: Annotated[int, typer.Option(help="Its DICOM port.")] = 104,
    own_title: Annotated[str, typer.Option(help="AE title of Acus.")] = "ACUS",
    own_host: Annotated[
        str, typer.Option(help="Address on which C-MOVE's pictures come; the one towards it.")
    ] = "",
    own_port: Annotated[int, typer.Option(help="Port on which C-MOVE's pictures come.")] = 11112,
    sender: Annotated[
        list[str] | None,
        typer.Option(help="Name or address beside the host that C-MOVE's pictures may come from."),
    ] = None,
    retrieve: Annotated[str, typer.Option(help="get or move.")] = "get",
    timeout_s: Annotated[float, typer.Option(help="Longest silence that is borne [s].")] = 30.0,
    tls: Annotated[bool, typer.Option("--tls", help="Encrypt the connections.")] = False,
    tls_authority: Annotated[str, typer.Option(help="Who signs its certificate, PEM.")] = "",
    tls_certificate: Annotated[str, typer.Option(help="Our own certificate, PEM.")] = "",
    tls_key: Annotated[str, typer.Option(help="Key of ours, PEM without a password.")] = "",
    tls_any_name: Annotated[
        bool, typer.Option("--tls-any-name", help="Its certificate may name another host.")
    ] = False,
    web: Annotated[
        str, typer.Option(metavar="URL", help="Of an archive that speaks DICOMweb.")
    ] = "",
    user: Annotated[str, typer.Option(help="With --web: name that it gave you.")] = "",
) -> Answer:
    """Configure a PACS, or change the one of that name.

    By --host and --title, or by --web. With --user the password is asked for, or stands in
    ACUS_DICOMWEB_PASSWORD.
    """
    from app.core.configuration import parse
    from app.imaging.pacs.settings import PacsSettings, configured, keep

    given: dict[str, Any] = {
        "name": name,
        "host": host,
        "title": title,
        "port": port,
        "own_title": own_title,
        "own_host": own_host,
        "own_port": own_port,
        "senders": tuple(sender or ()),
        "retrieve": retrieve,
        "timeout_s": timeout_s,
    }
    if user and not web:
        raise typer.BadParameter(sentence("give --user with --web"))
    if web:
        password = web_password() if user else ""
        given |= {"web": {"url": web, "user": user, "password": password}, "retrieve": "web"}
        given["port"] = None if port == 104 else port
    elif not (host and title):
        raise typer.BadParameter(sentence("give --host and --title, or --web"))
    if tls or tls_authority or tls_certificate or tls_key or tls_any_name:
        files = (tls_authority, tls_certificate, tls_key)
        given["tls"] = dict(
            zip(("authority", "certificate", "key"), map(_whole, files), strict=True)
        ) | {"check_name": not tls_any_name}
    one = parse(given, PacsSettings, "acus pacs add")
    keep((*(other for other in configured() if other.name != name), one))
    words = sentence(
        "{name} is configured; `acus pacs echo --pacs {name}` asks whether it is there", name=name
    )
    return Answer({"servers": [each.shown() for each in configured()]}, [words])


@app.command()
def remove(name: Annotated[str, typer.Argument(help="Which.")]) -> Answer:
    """Forget a configured PACS."""
    from app.imaging.pacs.settings import chosen, configured, keep

    gone = chosen(name)
    keep(tuple(one for one in configured() if one != gone))
    facts = {"servers": [each.shown() for each in configured()]}
    return Answer(facts, [sentence("{name} is forgotten", name=name)])


@app.command()
def echo(pacs: Server = None) -> Answer:
    """Ask a PACS whether it is there (C-ECHO, or by the web)."""
    from app.imaging.pacs.archive import archive_of
    from app.imaging.pacs.settings import chosen

    settings = chosen(pacs)
    seconds = archive_of(settings).echo()
    words = sentence("{name} answers in {time:.1f} ms", name=settings.name, time=1e3 * seconds)
    return Answer({"name": settings.name, "seconds": seconds}, [words])


@app.command()
def find(
    patient_id: Annotated[str, typer.Option(help="PatientID; * and ? as wildcards.")] = "",
    name: Annotated[str, typer.Option(help="Name, with wildcards.")] = "",
    date: Annotated[str, typer.Option(metavar="FROM-TO", help="YYYYMMDD, or a range.")] = "",
    accession: Annotated[str, typer.Option(help="Accession number.")] = "",
    study: Annotated[str, typer.Option(help="StudyInstanceUID.")] = "",
    modality: Annotated[str, typer.Option(help="CT or MR.")] = "CT",
    names: Annotated[bool, typer.Option("--names", help="Show who the patients are.")] = False,
    pacs: Server = None,
) -> Answer:
    """Find studies and their series (C-FIND, QIDO-RS).

    Who the patients are is shown only with --names. The JSON never has names, identifiers or
    descriptions.
    """
    from app.imaging.pacs.archive import archive_of
    from app.imaging.pacs.query import Query
    from app.imaging.pacs.settings import chosen

    query = Query(patient_id, name, date, accession, modality, study)
    client = archive_of(chosen(pacs))
    studies = client.find_studies(query)
    found = [series for one in studies for series in client.find_series(one, modality)]
    lines = [_line(one, names) for one in found]
    return Answer(
        {"series": [_series(one) for one in found]}, lines or [sentence("nothing matches")]
    )


@app.command()
def get(
    study: StudyUid,
    series: SeriesUid,
    pacs: Server = None,
    mask: Mask = None,
    remedy: Mend = None,
) -> Answer:
    """Take a series into the library (C-GET, WADO-RS), de-identified.

    Repeated, it fetches the rest.
    """
    return _take(study, series, pacs, "get", mask, remedy)


@app.command()
def move(
    study: StudyUid,
    series: SeriesUid,
    pacs: Server = None,
    mask: Mask = None,
    remedy: Mend = None,
) -> Answer:
    """Take a series into the library by C-MOVE. The PACS must know our AE title and port."""
    return _take(study, series, pacs, "move", mask, remedy)


@app.command()
def send(
    folder: Annotated[
        Path, typer.Argument(help="That `acus session export ID --dicom FOLDER` has written.")
    ],
    pacs: Server = None,
    web: Annotated[str, typer.Option("--web", metavar="URL", help="A DICOMweb archive.")] = "",
    user: Annotated[str, typer.Option("--user", help="With --web: name that it gave you.")] = "",
) -> Answer:
    """Send an attempt's objects by C-STORE or STOW-RS (instructor).

    With --user the password is asked for, or stands in ACUS_DICOMWEB_PASSWORD.
    """
    from app.commands.calibrate_parts import with_progress
    from app.commands.doors import instructor
    from app.imaging.pacs.settings import chosen
    from app.imaging.pacs.storing import own_objects, store
    from app.imaging.pacs.stow import stow
    from app.imaging.pacs.web import WebArchive
    from app.imaging.pacs.web_client import web_archive

    if (web and pacs) or (user and not web):
        raise typer.BadParameter(sentence("give --pacs NAME, or --web URL and --user NAME with it"))
    instructor()
    files = own_objects(folder)
    if web:
        archive = WebArchive(web, user, web_password() if user else "")
        name, count = archive.name, with_progress(lambda part: stow(archive, files, part))
    else:
        settings = chosen(pacs)
        name = settings.name
        if settings.retrieve == "web":
            known = web_archive(settings)
            count = with_progress(lambda part: stow(known, files, part))
        else:
            count = with_progress(lambda part: store(settings, files, part))
    words = template("{objects:#1 object|# objects} sent to {to}")
    return Answer({"to": name, "objects": count}, shown=words)


def _take(
    study: str,
    series: str,
    name: str | None,
    way: str,
    mask: list[str] | None,
    remedy: str | None,
) -> Answer:
    from app.commands.calibrate_parts import with_progress
    from app.commands.ct import boxes_of, imported_answer, remedy_of
    from app.imaging.library import CtLibrary
    from app.imaging.pacs.archive import archive_of
    from app.imaging.pacs.settings import chosen
    from app.imaging.pacs.taking import take

    boxes, asked = boxes_of(mask), remedy_of(remedy)
    settings: PacsSettings = chosen(name)
    if settings.retrieve != "web":
        settings = settings.model_copy(update={"retrieve": way})
    elif way == "move":
        raise typer.BadParameter(sentence("DICOMweb has no C-MOVE; use `acus pacs get`"))

    def work(progress: "Progress") -> "Imported":
        return take(archive_of(settings), study, series, CtLibrary(), progress, boxes, asked)

    return imported_answer(with_progress(work))


def web_password() -> str:
    """Return the password of an archive by the web: a variable's, or asked for."""
    from app.commands.doors import secret

    return os.environ.get(PASSWORD, "") or secret(sentence("Password"))


def _whole(file: str) -> str:
    """Path that means the same from every folder."""
    return str(Path(file).expanduser().absolute()) if file else ""


def _series(series: "FoundSeries") -> dict[str, Any]:
    return {
        "study": series.study.uid,
        "series": series.uid,
        "modality": series.modality,
        "date": series.study.date,
        "instances": series.instances,
    }


def _line(series: "FoundSeries", names: bool) -> str:
    study = series.study
    count = "?" if series.instances is None else str(series.instances)
    parts = [study.date, f"{series.modality} {count} pictures"]
    if names:
        parts += [study.patient_name, study.patient_id, study.description, series.description]
    return "  ".join([*(part for part in parts if part), study.uid, series.uid])
