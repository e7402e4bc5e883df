"""Results of runs behind the public ones: entries, files, snapshots, features."""
