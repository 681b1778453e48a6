"""Report: one offline HTML file about a run or about several runs beside each other."""
