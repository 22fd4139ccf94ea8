"""Which PACS there are: `pacs.yaml` in the settings folder."""

from pathlib import Path
from typing import Annotated, Any, Literal
from urllib.parse import urlsplit

import yaml
from pydantic import Field, model_validator

from app.core import paths
from app.core.configuration import FieldText, Strict, load
from app.core.errors import ConfigurationError
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.web import fault_of_address

Port = Annotated[int, Field(ge=1, le=65535)]
Host = Annotated[str, Field(min_length=1, max_length=253)]
Title = Annotated[str, Field(pattern=r"^[A-Za-z0-9_. -]{1,16}$")]


class TlsSettings(Strict):
    """Encryption of the connections; files are PEM, named by their whole paths.

    Attributes:
        authority: certificates that the PACS' own must be signed by; the system's where empty.
        certificate: our own; needed where the PACS wants one, and for C-MOVE.
        key: of our own certificate, not encrypted; may stand in the same file.
        check_name: whether the PACS' certificate must name the host that we connect to.
    """

    authority: Annotated[
        str, FieldText("Authority", "PEM; empty: those that the system trusts")
    ] = ""
    certificate: Annotated[
        str, FieldText("Own certificate", "PEM; where the archive asks for one")
    ] = ""
    key: Annotated[str, FieldText("Own key", "PEM without a password")] = ""
    check_name: Annotated[bool, FieldText("Its certificate must name the host")] = True


class WebSettings(Strict):
    """Where an archive speaks DICOMweb (PS3.18), and as whom.

    Attributes:
        url: of the service, before `/studies`; https, but on this computer.
        user: name that it knows us by; empty where it asks for none.
        password: that goes with it; in no message, no list and no JSON.
    """

    url: Annotated[
        str,
        Field(max_length=500),
        FieldText("Web address", "https://…/dicom-web, before /studies"),
    ]
    user: Annotated[
        str,
        Field(max_length=200),
        FieldText("User", "name that the archive gave you; may stay empty"),
    ] = ""
    password: Annotated[
        str,
        Field(max_length=500, repr=False),
        FieldText("Password", "kept in a file that only you can read"),
    ] = ""

    @model_validator(mode="after")
    def _can_be_asked(self) -> "WebSettings":
        if fault := fault_of_address(self.url):
            raise ValueError(fault)
        return self


class PacsSettings(Strict):
    """One PACS.

    Attributes:
        name: what it is called here.
        host: name or address.
        port: of its DICOM service.
        title: its AE title, at most 16 characters.
        own_title: AE title of this program; the PACS may have to be told of it.
        own_host: address on which C-MOVE's pictures are received; where empty, the one of this
            computer that the way to the PACS leads out of.
        own_port: port of the same.
        senders: names or addresses beside `host` that C-MOVE's pictures may come from.
        timeout_s: longest silence that is borne [s]; a request as a whole may take four of them,
            and more for what comes.
        retrieve: `get` over the same connection, `move` to `own_port`, or `web` by DICOMweb.
        tls: encryption; none where absent, and the system's for DICOMweb.
        web: where and as whom with `web`; host, port and title follow from it if left out.
    """

    name: Annotated[
        str,
        Field(pattern=r"^[A-Za-z0-9_.-]{1,32}$"),
        FieldText("Name", "what it is called here; no blanks"),
    ]
    host: Annotated[Host, FieldText("Host", "name or address of the archive")]
    port: Annotated[Port, FieldText("Port")]
    title: Annotated[Title, FieldText("AE title", "the archive's, at most 16 characters")]
    own_title: Annotated[Title, FieldText("Own AE title", "tell the archive's administrator")] = (
        "ACUS"
    )
    own_host: Annotated[
        str,
        Field(max_length=253),
        FieldText("Own address", "empty: the one that leads to the archive"),
    ] = ""
    own_port: Annotated[Port, FieldText("Own port")] = 11112
    senders: Annotated[
        tuple[Host, ...],
        Field(max_length=32),
        FieldText("Other senders", "empty: pictures come from the host alone"),
    ] = ()
    timeout_s: Annotated[float, Field(gt=0.0, le=600.0), FieldText("Longest silence")] = 30.0
    retrieve: Annotated[Literal["get", "move", "web"], FieldText("Retrieve by")] = "get"
    tls: TlsSettings | None = None
    web: WebSettings | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_address(cls, values: Any) -> Any:
        web = values.get("web") if isinstance(values, dict) else None
        if not isinstance(web, dict):
            return values
        try:
            parts = urlsplit(str(web.get("url", "")))
            port = parts.port or (443 if parts.scheme == "https" else 80)
        except ValueError:
            return values
        follow = {"host": parts.hostname or "?", "port": port, "title": "DICOMWEB"}
        own = {name: value for name, value in values.items() if value or name not in follow}
        return follow | own

    @model_validator(mode="after")
    def _way(self) -> "PacsSettings":
        if self.retrieve == "web" and self.web is None:
            raise ValueError(
                sentence("retrieve is web: say where by web: {{url: https://…}}, or use get")
            )
        return self

    def shown(self) -> dict[str, Any]:
        """Return the settings for lists and JSON: all but the password."""
        document = self.model_dump(mode="json")
        if self.web is not None:
            del document["web"]["password"]
        return document


class PacsList(Strict):
    """All of them."""

    servers: tuple[PacsSettings, ...] = ()


def pacs_path() -> Path:
    """File of the configuration."""
    return paths.settings() / "pacs.yaml"


def configured() -> tuple[PacsSettings, ...]:
    """Every configured PACS.

    Raises:
        ConfigurationError: naming the field that cannot be used.
    """
    path = pacs_path()
    return load(path, PacsList).servers if path.exists() else ()


def chosen(name: str | None) -> PacsSettings:
    """Return the PACS of a name, or the only one.

    Raises:
        ConfigurationError: if there is none, or several and none was named.
    """
    servers = configured()
    if name is None and len(servers) == 1:
        return servers[0]
    for server in servers:
        if server.name == name:
            return server
    if not servers:
        raise ConfigurationError(
            sentence(
                "no PACS is configured; acus pacs add NAME --host HOST --port PORT --title AE "
                "writes {pacs_path}",
                pacs_path=pacs_path(),
            )
        )
    names = ", ".join(server.name for server in servers)
    raise ConfigurationError(
        sentence("no PACS {name!r}", name=name)
        if name
        else sentence("name one of the PACS: {names}", names=names)
    )


def keep(servers: tuple[PacsSettings, ...]) -> None:
    """Write the configuration."""
    document = {"servers": [_written(server) for server in servers]}
    write_atomically(pacs_path(), yaml.safe_dump(document, sort_keys=False))
    pacs_path().chmod(0o600)  # it may hold a password


def _written(server: PacsSettings) -> dict[str, Any]:
    """Return the settings as plain values; an empty list is left out."""
    found = server.model_dump(mode="json", exclude_none=True)
    return {name: value for name, value in found.items() if value != []}
