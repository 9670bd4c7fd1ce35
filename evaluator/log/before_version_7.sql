-- What match logs before version 7 lack alike: views of this connection. Nobody measured another's clock, and nothing was
-- merged by a program.
CREATE TEMP VIEW clock_offsets AS
SELECT NULL AS session_id, NULL AS robot_id, NULL AS other_robot_id, NULL AS t_ns, NULL AS offset_ns, NULL AS error_ns
WHERE 0;

CREATE TEMP VIEW session_clocks AS
SELECT NULL AS session_id, NULL AS from_t_ns, NULL AS utc_offset_ns, NULL AS rate, NULL AS error_ns,
  NULL AS reference_uuid
WHERE 0;

CREATE TEMP VIEW merged_sessions AS
SELECT NULL AS session_id, NULL AS file, NULL AS from_version, NULL AS row_count, NULL AS damage WHERE 0;
