"""The pen with printed markers: its print, its page in the window, its calibration."""
