within AntonWalk;
model Steered "Anton walks as an operator steers it"
  import SI = Modelica.Units.SI;
  extends SixLegs(startAdvance=0);
  parameter Real deadZone(
    min=0,
    max=0.5,
    unit="1")=0.1 "Share of the greatest speed and turning rate below which a wish counts as none" annotation (Dialog(group="Steering"));
  parameter SI.Time reaction=0.3 "Time constant with which wishes are followed" annotation (Dialog(group="Steering"));
  parameter Real steepest(unit="1/s")=1.5 "Greatest rate of advance and turn" annotation (Dialog(group="Steering"));
  parameter SI.Velocity steepestRaise=0.02 "Greatest speed of the height" annotation (Dialog(group="Steering"));
  final parameter SI.Velocity fastest=gait.cycleLength/gait.period "Greatest walking speed";
  final parameter SI.AngularVelocity quickest=gait.turn/gait.dutyFactor/gait.period "Greatest turning rate";
  Modelica.Blocks.Interfaces.RealInput speed(
    unit="m/s",
    min=-0.12,
    max=0.12,
    start=0) "Walking speed, negative backwards" annotation (Placement(transformation(extent={{-220,80},{-180,120}})));
  Modelica.Blocks.Interfaces.RealInput turning(
    unit="rad/s",
    min=-0.36,
    max=0.36,
    start=0) "Turning rate, positive to the left" annotation (Placement(transformation(extent={{-220,30},{-180,70}})));
  Modelica.Blocks.Interfaces.RealInput height(
    unit="m",
    min=-0.02,
    max=0.02,
    start=0) "Height of the torso against its usual one" annotation (Placement(transformation(extent={{-220,-20},{-180,20}})));
  SI.Angle heading "Direction in which the torso looks, from the x axis";
protected
  Real wish[2](each unit="1") "Wished shares of stride and turn";
  Real pace(unit="1", start=0, fixed=true, stateSelect=StateSelect.always) "Share of the full rate of the cycle";
  Real free(unit="1") "0 where all six feet stand, 1 amid the swing of one group";
initial equation
  cycle = 0;
  advance = 0;
  turn = 0;
  raise = 0;
equation
  wish = wishedShares(speed/fastest, turning/quickest, deadZone);
  free = freeShare(cycle, gait.dutyFactor);
  advanceRate = free*limited((wish[1] - advance)/reaction, steepest);
  turnRate = free*limited((wish[2] - turn)/reaction, steepest);
  raiseSpeed = limited((limited(height, 0.02) - raise)/reaction, steepestRaise);
  der(advance) = advanceRate;
  der(turn) = turnRate;
  der(raise) = raiseSpeed;
  der(pace) = (wantedPace(wish, {advance,turn}, free) - pace)/reaction;
  rate = pace/gait.period;
  der(cycle) = rate;
  heading = atan2(torso.frame_a.R.T[1, 2], torso.frame_a.R.T[1, 1]);
  annotation (
    experiment(StopTime=25, Tolerance=1e-4, Interval=0.007),
    Diagram(coordinateSystem(preserveAspectRatio=false, extent={{-220,-1520},{520,120}})),
    Documentation(info="<html>
<p>
Walking speed and turning rate are shares of the greatest ones; those together above the whole are reduced alike. What lies within the dead
zone counts as none. Shares follow the wishes with limited rates, and only while one group of legs stands: its feet move
against the torso as one rigid body, so that none slips. While all six stand the shares are kept. Without a wish the group that swings is set
down before the cycle stops.
</p>
</html>"));
end Steered;
