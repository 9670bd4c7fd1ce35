-- What match logs before version 8 lack alike: views of this connection. Nobody has labelled, noted or counted anything.
CREATE TEMP VIEW labels AS
SELECT NULL AS session_id, NULL AS robot_id, NULL AS kick_id, NULL AS utc_ns, NULL AS who, NULL AS t_ns,
  NULL AS outcome, NULL AS note
WHERE 0;

CREATE TEMP VIEW notes AS
SELECT NULL AS session_id, NULL AS kind, NULL AS utc_ns, NULL AS who, NULL AS text
WHERE 0;

CREATE TEMP VIEW session_tallies AS
SELECT NULL AS session_id, NULL AS robot_id, NULL AS policy, NULL AS in_charge, NULL AS decisions, NULL AS fires,
  NULL AS first_t_ns, NULL AS last_t_ns, NULL AS possessions
WHERE 0;

CREATE TEMP VIEW possession_tallies AS
SELECT NULL AS session_id, NULL AS robot_id, NULL AS half, NULL AS possession_id, NULL AS counted_by,
  NULL AS first_seq, NULL AS decisions, NULL AS fires, NULL AS from_t_ns, NULL AS to_t_ns, NULL AS played_ns
WHERE 0;

CREATE TEMP VIEW order_tallies AS
SELECT NULL AS session_id, NULL AS robot_id, NULL AS first_t_ns, NULL AS first_handled, NULL AS first_refused,
  NULL AS handled_within, NULL AS refused_within
WHERE 0;

CREATE TEMP VIEW referee_tallies AS
SELECT NULL AS session_id, NULL AS robot_id, NULL AS half, NULL AS words, NULL AS first_t_ns, NULL AS last_t_ns
WHERE 0;

CREATE TEMP VIEW ball_turns AS
SELECT NULL AS session_id, NULL AS turn, NULL AS y_m
WHERE 0;

CREATE TEMP VIEW tallied_sessions AS
SELECT NULL AS session_id, NULL AS sha256
WHERE 0;

CREATE TEMP VIEW counted_sessions AS
SELECT NULL AS session_id
WHERE 0;
