-- What a comparison asks of the sessions, without their long texts.
-- Columns: session_id, started_utc_ns, closed_utc_ns (NULL: never finalised), seed, scenario, simulated, arm,
-- kicker_table, match_id, config_sha256, calibration_id.
SELECT session_id, started_t_ns + realtime_offset_ns AS started_utc_ns, closed_t_ns + realtime_offset_ns AS closed_utc_ns,
  seed, scenario, simulated, arm, kicker_table, match_id, config_sha256, calibration_id
FROM sessions
ORDER BY started_utc_ns, session_id;
