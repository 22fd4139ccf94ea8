"""Looks are kept: pictures of the window's pages and states, judged by rules and compared."""
