"""A PACS, reading only: ask, find, retrieve; what comes enters de-identified or not at all."""
