-- What match logs before version 6 lack alike: views of this connection that stand before their tables. Kick_decision alone
-- drove; an order was given with the ball alone; of the kicker's driver they hold no state. Robots went by the referee's
-- count of possessions, which the simulator's was, too.
CREATE TEMP VIEW odometry AS
SELECT o.*, 'kick_decision' AS obeyed
FROM main.odometry AS o;

CREATE TEMP VIEW team_drives AS
SELECT session_id, robot_id, seq, t_ns, vx_mps, vy_mps, omega_radps FROM main.drive_commands WHERE 0;

CREATE TEMP VIEW kick_orders AS
SELECT o.*, 1 AS possession
FROM main.kick_orders AS o;

CREATE TEMP VIEW kicker_status AS
SELECT s.*, CASE WHEN fault <> 'none' THEN 'fault' WHEN NOT armed THEN 'off' WHEN ready THEN 'ready' ELSE 'charging' END
  AS state, 0 AS charge_modelled, NULL AS voltage_v
FROM main.kicker_status AS s;

CREATE TEMP VIEW IF NOT EXISTS assignments AS
SELECT a.*, NULL AS t_ns
FROM main.assignments AS a;
