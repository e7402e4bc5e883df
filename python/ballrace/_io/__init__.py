"""Files: paths, whole or absent writing, Parquet with a hash, records of runs, TOML."""
