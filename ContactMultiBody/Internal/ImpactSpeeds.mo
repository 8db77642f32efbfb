within ContactMultiBody.Internal;
block ImpactSpeeds "Catches the approach speed at the start of each contact"
  extends Modelica.Blocks.Icons.Block;
  parameter Integer m "Number of pairs" annotation (Evaluate=true);
  input Boolean touches[m] "= true, if the bodies of the pair touch";
  input Modelica.Units.SI.Velocity approachSpeed[m] "Approach speed of each pair";
  output Modelica.Units.SI.Velocity impactSpeed[m](each start=0, each fixed=true)
    "Approach speed of each pair when its last contact started";
equation
  when touches then
    impactSpeed = caughtSpeeds(touches, pre(touches), approachSpeed, pre(impactSpeed));
  end when;
  annotation (Documentation(info="<html>
<p>
An event whenever a contact starts. A contact that exists when the simulation starts is taken to have started at rest.
</p>
</html>"));
end ImpactSpeeds;
