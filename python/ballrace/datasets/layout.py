"""The table of ``bearing-datasets`` 0.3.0 (schema version 2): columns that are written, and what they mean."""

from __future__ import annotations

SCHEMA_VERSION = 2

COLUMNS = {
    "dataset": "name of the set",
    "signal_id": "the signal: recording_id/channel",
    "recording_id": "the case of the campaign, with the measuring chain if there are any",
    "native_label": "what the scene holds, met or not: surface and width of each defect, or healthy",
    "channel": "sensor, or a column of the run",
    "sensor_location": "what the sensor measures: test_bearing",
    "quantity": "acceleration",
    "unit": "m/s^2",
    "axis": "direction of the sensor: horizontal x, vertical y, axial z; unknown: oblique",
    "sensor_mounting": "pedestal: on the structure of the scene, or a path from its seat; else outer_ring",
    "fs": "sampling rate in Hz",
    "n_samples": "number of samples",
    "speed_rpm": "speed of the rings against each other in 1/min; where it changes, in the middle of the record",
    "speed_profile": "constant, increasing, decreasing or varying",
    "load": "magnitude of the sum of all loads, in load_unit; of loads that change in the middle of the record",
    "load_unit": "N",
    "operating_condition": "speed and load in words",
    "fault_type": "surfaces with a defect that a loaded contact met in the run, joined by +; normal: none was met",
    "fault_location": "test_bearing, once a fault; none if normal",
    "sensor_at_fault": "True if there is a fault: the sensor is at the only bearing",
    "fault_origin": "artificial; none if normal",
    "fault_size_mm": "largest width of the defects that were met, along the race, in mm; 0 if normal",
    "fault_severity": "that width in words; none if normal",
    "fault_severity_level": "rank of that width among those of its fault_type; 0 if normal",
    "bearing_id": "the bearing: what the table of the campaign calls it, or else a hash of its rows and defects",
    "bearing_model": "name of the scene",
    "bpfo": "ball pass frequency of the outer race of the row with the first defect, in orders of the shaft",
    "bpfi": "ball pass frequency of the inner race of that row, in orders of the shaft",
    "bsf": "ball spin frequency of that row, in orders of the shaft; a defect of a ball shows at twice that",
    "ftf": "fundamental train (cage) frequency of that row, in orders of the shaft",
    "signal_file": "file in signals/ that holds the samples",
    "signal_row_group": "its row group: 0, each file has one",
    "signal_row": "row in it",
}
"""Meaning by column, in the order of the table."""
