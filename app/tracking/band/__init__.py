"""The fit of the red band's picture: a library with its derivation in docs/band-fit.md."""
