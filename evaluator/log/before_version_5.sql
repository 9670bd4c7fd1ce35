-- What match logs before version 5 lack alike: a view of this connection that stands before their table. Of the referee
-- they hold who may play, and nothing that was announced or counted.
CREATE TEMP VIEW referee AS
SELECT r.*, 'unknown' AS stage, 'none' AS restart, 0 AS ours, 0 AS goals_own, 0 AS goals_other, 0 AS command_counter,
  NULL AS half_time_s
FROM main.referee AS r;
