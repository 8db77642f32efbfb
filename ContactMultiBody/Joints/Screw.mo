within ContactMultiBody.Joints;
model Screw "Joint that moves along its axis as it turns"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialElementaryJoint;
  parameter Boolean useAxisFlange=false "= true, if the flanges axis and support exist" annotation (Evaluate=true, choices(checkBox=true));
  Modelica.Mechanics.Rotational.Interfaces.Flange_a axis(phi=phi, tau=tau) if useAxisFlange "Flange that turns with frame_b"
    annotation (Placement(transformation(extent={{10,90},{-10,110}})));
  Modelica.Mechanics.Rotational.Interfaces.Flange_b support(phi=0) if useAxisFlange "Flange of the housing, at rest in frame_a"
    annotation (Placement(transformation(extent={{-70,90},{-50,110}})));
  parameter Modelica.Mechanics.MultiBody.Types.Axis n={0,0,1} "Axis, the same in frame_a and frame_b" annotation (Evaluate=true);
  parameter Modelica.Units.SI.Length pitch=0.005 "Way along the axis in one turn about it; negative: left-hand thread";
  parameter StateSelect stateSelect=StateSelect.prefer "Priority of phi and w as states" annotation (Dialog(tab="Advanced"));
  Modelica.Units.SI.Angle phi(start=0, stateSelect=stateSelect) "Angle of the rotation from frame_a to frame_b";
  Modelica.Units.SI.AngularVelocity w(start=0, stateSelect=stateSelect) "Derivative of phi";
  Modelica.Units.SI.AngularAcceleration a(start=0) "Derivative of w";
  Modelica.Units.SI.Position s "Way along the axis";
  Modelica.Units.SI.Torque tau "Driving torque about the axis";
protected
  final parameter Real e[3](each final unit="1")=Modelica.Math.Vectors.normalizeWithAssert(n) "Axis of length 1";
  final parameter Real lead(final unit="m/rad")=pitch/(2*Modelica.Constants.pi) "Way along the axis for an angle of 1 rad";
  Modelica.Mechanics.MultiBody.Frames.Orientation R_rel "Orientation of the frame further from the root with respect to the nearer one";
equation
  s = lead*phi;
  w = der(phi);
  a = der(w);
  frame_b.r_0 = frame_a.r_0 + Modelica.Mechanics.MultiBody.Frames.resolve1(frame_a.R, e*s);
  if Connections.rooted(frame_a.R) then
    R_rel = Modelica.Mechanics.MultiBody.Frames.planarRotation(e, phi, w);
    frame_b.R = Modelica.Mechanics.MultiBody.Frames.absoluteRotation(frame_a.R, R_rel);
    frame_a.f = -Modelica.Mechanics.MultiBody.Frames.resolve1(R_rel, frame_b.f);
    frame_a.t = -Modelica.Mechanics.MultiBody.Frames.resolve1(R_rel, frame_b.t) + cross(e*s, frame_a.f);
  else
    R_rel = Modelica.Mechanics.MultiBody.Frames.planarRotation(-e, phi, w);
    frame_a.R = Modelica.Mechanics.MultiBody.Frames.absoluteRotation(frame_b.R, R_rel);
    frame_b.f = -Modelica.Mechanics.MultiBody.Frames.resolve1(R_rel, frame_a.f);
    frame_b.t = -Modelica.Mechanics.MultiBody.Frames.resolve1(R_rel, frame_a.t) - cross(e*s, frame_b.f);
  end if;
  tau = -frame_b.t*e - lead*(frame_b.f*e);
  if not useAxisFlange then
    tau = 0;
  end if;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,60},{-20,-60}}, lineColor={64,64,64}, fillColor={192,192,192}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{-20,25},{100,-25}}, lineColor={64,64,64}, fillColor={220,220,220}, fillPattern=FillPattern.HorizontalCylinder),
        Line(points={{-10,-25},{5,25},{20,-25},{35,25},{50,-25},{65,25},{80,-25},{95,25}}, color={64,64,64}),
        Text(extent={{-150,-70},{150,-110}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>
frame_b turns about the axis <code>n</code>, fixed in both frames, by <code>phi</code> and moves along it by <code>s = pitch/(2 pi) phi</code>;
for <code>phi = 0</code> the frames coincide. The constraint does no work: the torque about the axis and the force along it balance,
<code>tau = -frame_b.t*n - pitch/(2 pi) frame_b.f*n</code>. With <code>useAxisFlange = true</code> a drive can be connected to
<code>axis</code> and <code>support</code>.
</p>
</html>"));
end Screw;
