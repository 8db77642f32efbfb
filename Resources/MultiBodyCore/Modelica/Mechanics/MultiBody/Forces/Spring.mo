within Modelica.Mechanics.MultiBody.Forces;
model Spring "Linear spring between two frames"
  import Modelica.Mechanics.MultiBody.Types;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  parameter Boolean animation=true "= true, if the spring is shown";
  parameter Boolean showMass=true "= true, if the mass is shown";
  parameter SI.TranslationalSpringConstant c(final min=0) "Stiffness";
  parameter SI.Length s_unstretched=0 "Length of the relaxed spring";
  parameter SI.Mass m(min=0) = 0 "Mass of the spring, a point on the line between the frames";
  parameter Real lengthFraction(min=0, max=1) = 0.5 "Where the mass is: 0 at frame_a, 1 at frame_b";
  input SI.Distance width=world.defaultForceWidth "Width of the spring" annotation (Dialog(tab="Animation"));
  input SI.Distance coilWidth=width/10 "Width of the wire" annotation (Dialog(tab="Animation"));
  parameter Integer numberOfWindings=5 "Number of windings" annotation (Dialog(tab="Animation"));
  input Types.Color color=Modelica.Mechanics.MultiBody.Types.Defaults.SpringColor "Colour of the spring" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  input SI.Diameter massDiameter=max(0, (width - 2*coilWidth)*0.9) "Diameter of the mass" annotation (Dialog(tab="Animation"));
  input Types.Color massColor=Modelica.Mechanics.MultiBody.Types.Defaults.BodyColor "Colour of the mass" annotation (Dialog(tab="Animation"));
  parameter SI.Distance s_small=1e-10 "The distance counts as at least this, so that nothing is divided by zero" annotation (Dialog(tab="Advanced"));
  parameter Boolean fixedRotationAtFrame_a=false "= true, if frame_a shall be parallel to the world frame because nothing else turns it"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Boolean fixedRotationAtFrame_b=false "= true, if frame_b shall be parallel to the world frame because nothing else turns it"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  SI.Position r_rel_a[3] "Position of frame_b from the origin of frame_a, in coordinates of frame_a";
  Real e_a[3](each final unit="1") "Its direction";
  SI.Force f "Force that pulls the ends together";
  SI.Distance length "Distance of the frames";
  SI.Position s "The same, but at least s_small";
  SI.Position r_rel_0[3] "Position of frame_b from the origin of frame_a, in coordinates of the world frame";
  Real e_rel_0[3](each final unit="1") "Its direction";
  LineForceWithMass lineForce(
    final animateLine=animation,
    final animateMass=showMass,
    final m=m,
    final lengthFraction=lengthFraction,
    final s_small=s_small,
    final fixedRotationAtFrame_a=fixedRotationAtFrame_a,
    final fixedRotationAtFrame_b=fixedRotationAtFrame_b) "Carries the force to the frames";
  Modelica.Mechanics.Translational.Components.Spring spring(final s_rel0=s_unstretched, final c=c) "Computes the force";
equation
  connect(lineForce.frame_a, frame_a);
  connect(lineForce.frame_b, frame_b);
  connect(spring.flange_a, lineForce.flange_a);
  connect(spring.flange_b, lineForce.flange_b);
  r_rel_a = Frames.resolve2(frame_a.R, r_rel_0);
  e_a = r_rel_a/s;
  f = spring.f;
  length = lineForce.length;
  s = lineForce.s;
  r_rel_0 = lineForce.r_rel_0;
  e_rel_0 = lineForce.e_rel_0;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{-60,0},{-45,30},{-15,-30},{15,30},{45,-30},{60,0},{100,0}}, color={0,0,160}, thickness=1),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>The force <code>c*(s - s_unstretched)</code> along the line between the origins of the frames pulls them together. A mass on
that line can be given, which is heavy and inert but has no moments of inertia.</p></html>"));
end Spring;
