-- A match log of version 1 as queries of version 8 know it: views of this connection that stand before its tables.
-- What version 1 did not have is empty, NULL or what was true then.
CREATE TEMP VIEW texts AS
SELECT config_sha256 AS sha256, config_toml AS text FROM main.sessions GROUP BY config_sha256
UNION ALL
SELECT 'idl of session ' || session_id, idl FROM main.sessions;

CREATE TEMP VIEW sessions AS
SELECT s.*, 'idl of session ' || session_id AS idl_sha256, NULL AS arm, NULL AS kicker_table, NULL AS match_id,
  NULL AS continues_uuid, CASE WHEN s.scenario LIKE 'replay of %' THEN 'not noted' END AS replays_uuid,
  s.simulated AS paired_halves, NULL AS planned_s, NULL AS calibration_id
FROM main.sessions AS s;

CREATE TEMP VIEW experiments AS
SELECT NULL AS arguments_sha256, NULL AS arguments, NULL AS matches, NULL AS matches_done WHERE 0;

CREATE TEMP VIEW assignments AS
SELECT NULL AS session_id, NULL AS robot_id, NULL AS half, NULL AS possession_id, NULL AS policy, NULL AS probability,
  NULL AS t_ns
WHERE 0;

CREATE TEMP VIEW kick_decisions AS
SELECT d.*, NULL AS p_on_target, 0.0 AS fire_after_s, 1.0 AS assignment_probability FROM main.kick_decisions AS d;

CREATE TEMP VIEW shadow_decisions AS
SELECT d.*, NULL AS p_on_target, 0.0 AS fire_after_s FROM main.shadow_decisions AS d;

CREATE TEMP VIEW kick_truths AS
SELECT t.*, 0 AS saved, NULL AS bounced FROM main.kick_truths AS t;

CREATE TEMP VIEW kicks_of_version_3 AS
SELECT k.*, 0 AS truth_saved FROM kicks_of_version_1 AS k;

CREATE TEMP VIEW continued AS
SELECT NULL AS session_id, NULL AS robot_id, NULL AS orders_handled, NULL AS orders_refused WHERE 0;

CREATE TEMP VIEW digests AS
SELECT NULL AS session_id, NULL AS row_count, NULL AS sha256 WHERE 0;

CREATE TEMP VIEW kick_receipts AS
SELECT r.*, 0 AS received_steady_ns, 0 AS fired_steady_ns FROM main.kick_receipts AS r;

CREATE TEMP VIEW losses AS
SELECT l.*, 0 AS robot_id, (SELECT started_t_ns FROM main.sessions AS s WHERE s.session_id = l.session_id) AS from_t_ns,
  NULL AS to_t_ns
FROM main.losses AS l;
