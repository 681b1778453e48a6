"""Report: one offline HTML file about a run, several runs beside each other, a sweep or a calibration."""
