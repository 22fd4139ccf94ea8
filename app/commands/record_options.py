"""The option of the commands that read attempts: in which folder they are."""

from pathlib import Path
from typing import Annotated

import typer

RecordsFolder = Annotated[Path | None, typer.Option("--folder", help="Folder of the records.")]
