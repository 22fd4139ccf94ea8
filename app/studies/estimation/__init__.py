"""What the studies of estimators need: motions of a hand, their measurement, filters of a depth."""
