"""Pure geometry, statics and dynamics of what points a needle at a fulcrum."""
