-- A match log of version 3 as queries of version 8 know it: views of this connection that stand before its tables.
-- What version 3 did not have is empty, NULL or what was true then.
CREATE TEMP VIEW sessions AS
SELECT s.*, CASE WHEN s.scenario LIKE 'replay of %' THEN 'not noted' END AS replays_uuid,
  s.simulated AS paired_halves, NULL AS planned_s, NULL AS calibration_id
FROM main.sessions AS s;

CREATE TEMP VIEW kick_truths AS
SELECT t.*, NULL AS bounced FROM main.kick_truths AS t;
