"""Results as tables in files: CSV, XLSX and NetCDF."""
