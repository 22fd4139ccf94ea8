"""PACS in the window: searched, configured, a series of one taken into the library."""
