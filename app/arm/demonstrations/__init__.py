"""The arm as what shows an exercise."""
