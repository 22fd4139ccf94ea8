"""The command `acus`, and `python -m acus`: the program's command line (`app.__main__`)."""


def main() -> None:
    """Run the command line of the program beside this package, never of another `app`."""
    from app.__main__ import main as run  # the package has bound the name

    run()


if __name__ == "__main__":
    main()
