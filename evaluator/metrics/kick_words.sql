-- Every kick that a recording of a match has, with how much it knows of it; an experiment's are nobody else's.
-- Columns: session_id, robot_id, kick_id, t_ns, utc_ns, words (0: it was decided; 1: with a receipt; 2: refused, or
-- with an outcome; 3: with one that is known), half, labelled_utc_ns (of the label by hand that holds; 0: none).
SELECT k.session_id, k.robot_id, k.kick_id, k.t_ns, k.t_ns + u.utc_offset_ns AS utc_ns,
  (k.accepted IS NOT NULL) + (k.accepted IS 0 OR k.outcome IS NOT NULL) + (coalesce(k.outcome, 'unknown') <> 'unknown')
    AS words, k.half, k.labelled_utc_ns
FROM labelled_kicks AS k
JOIN sessions AS s ON s.session_id = k.session_id
JOIN utc_offsets AS u ON u.session_id = k.session_id
WHERE s.match_id IS NULL
ORDER BY k.session_id, k.t_ns, k.robot_id, k.kick_id;
