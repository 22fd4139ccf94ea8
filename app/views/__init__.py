"""Everything Qt, VTK and pyqtgraph."""
