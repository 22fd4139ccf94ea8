"""Make the pictures of the shipped exercises' built-in patients that ship in resources/portraits.

    python -m tools.portraits

A picture is named by a digest of its exercise's patient and plan: what another exercise left behind
is removed. Each patient is made in full once, some ten seconds, unless the cache has it.
"""

from app.exercises.library import folders, library
from app.exercises.portrait import make_portrait, portrait_file, shipped_portraits
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct


def main() -> None:
    """Make what lacks, remove what no exercise has, and print how many there are."""
    folder, shipped, known = shipped_portraits(), folders()[0], library()
    exercises = [exercise for exercise in known if known.files[exercise.id].parent == shipped]
    wanted = {portrait_file(exercise, folder): exercise for exercise in exercises}
    for file, exercise in wanted.items():
        if not file.exists():
            seed = exercise.ct.phantom.seed if exercise.ct.phantom else 1
            make_portrait(exercise, load_ct(phantom_series(seed)), folder)
            print(f"{exercise.id}: {file.stat().st_size / 1e3:.0f} kB")
    for file in set(folder.glob("*.npz")) - set(wanted):
        file.unlink()
    print(f"{len(wanted)} pictures in {folder.name}")


if __name__ == "__main__":
    main()
