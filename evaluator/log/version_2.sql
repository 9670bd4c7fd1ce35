-- A match log of version 2 as queries of version 8 know it: views of this connection that stand before its tables.
-- What version 2 did not have is empty, NULL or what was true then.
CREATE TEMP VIEW sessions AS
SELECT s.*, NULL AS continues_uuid, CASE WHEN s.scenario LIKE 'replay of %' THEN 'not noted' END AS replays_uuid,
  s.simulated AS paired_halves, NULL AS planned_s, NULL AS calibration_id
FROM main.sessions AS s;

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

CREATE TEMP VIEW kick_truths AS
SELECT t.*, NULL AS bounced FROM main.kick_truths AS t;
