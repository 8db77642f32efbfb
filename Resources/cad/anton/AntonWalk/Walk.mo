within AntonWalk;
model Walk "Anton walks straight ahead"
  import SI = Modelica.Units.SI;
  extends SixLegs;
  SI.Position commandedTravel "Distance that the gait asks for";
  SI.Position travel "Distance the torso came forward";
protected
  Real ramp(unit="1") "Share of the ramp that is over";
equation
  ramp = noEvent(max(0, min(1, (time - gait.startTime)/gait.rampTime)));
  rate = ramp^2*(3 - 2*ramp)/gait.period;
  cycle = (gait.rampTime*ramp^3*(1 - ramp/2) + noEvent(max(0, time - gait.startTime - gait.rampTime)))/gait.period;
  advance = 1;
  advanceRate = 0;
  turn = 0;
  turnRate = 0;
  raise = 0;
  raiseSpeed = 0;
  commandedTravel = gait.cycleLength*cycle;
  travel = torso.frame_a.r_0[1];
  annotation (
    experiment(StopTime=25, Tolerance=1e-4, Interval=0.007),
    Documentation(info="<html>
<p>
Anton stands with all feet on the floor, three of them in front and three behind their middle positions. With the start command the six
<a href=\"modelica://AntonWalk.LegDrive\">drives</a> begin their cycles, slowly at first.
</p>
</html>"));
end Walk;
