-- What counting asks of the sessions, without their long texts.
-- Columns: session_id, started_utc_ns, closed_utc_ns (NULL: never finalised), seed, scenario, simulated, arm,
-- kicker_table, match_id, config_sha256, uuid, continues_uuid ('' in a text: none), is_replay, paired_halves, lockstep
-- (1: the clock is the simulator's), ended_utc_ns (of the last row, where it was never finalised), row_count (that the
-- recorder wrote; of an experiment its possessions), calibration_id, imported (1: no robot recorded it).
SELECT session_id, started_t_ns + utc_offset_ns AS started_utc_ns, closed_t_ns + utc_offset_ns AS closed_utc_ns,
  seed, scenario, simulated, coalesce(arm, '') AS arm, coalesce(kicker_table, '') AS kicker_table, match_id,
  config_sha256, uuid, coalesce(continues_uuid, '') AS continues_uuid,
  replays_uuid IS NOT NULL AS is_replay, paired_halves, clock = 'simulated' AS lockstep,
  coalesce(closed_t_ns, (SELECT max(to_t_ns) FROM losses AS l WHERE l.session_id = s.session_id AND l.robot_id = 0),
    started_t_ns) + utc_offset_ns AS ended_utc_ns,
  CASE WHEN match_id IS NULL
    THEN (SELECT CAST(total(received - overflow - nan_refused - rejected) AS INTEGER) FROM losses AS l
      WHERE l.session_id = s.session_id AND l.robot_id = 0)
    ELSE (SELECT count(*) FROM possession_truths AS t WHERE t.session_id = s.session_id) END AS row_count,
  calibration_id, session_id IN (SELECT session_id FROM imported_sessions) AS imported
FROM sessions AS s JOIN utc_offsets USING (session_id)
ORDER BY started_utc_ns, session_id;
