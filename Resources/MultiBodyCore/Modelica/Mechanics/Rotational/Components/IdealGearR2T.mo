within Modelica.Mechanics.Rotational.Components;
model IdealGearR2T "Rack and pinion, without loss and inertia"
  parameter Boolean useSupportR=false "= true, if the rotational support exists, else that housing stands still";
  parameter Boolean useSupportT=false "= true, if the translational support exists, else that housing stands still";
  Modelica.Mechanics.Rotational.Interfaces.Flange_a flangeR "Flange that turns" annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
  Modelica.Mechanics.Translational.Interfaces.Flange_b flangeT "Flange that slides" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  Modelica.Mechanics.Rotational.Interfaces.Support supportR(phi=phi_support, tau=-flangeR.tau) if useSupportR "Rotational housing"
    annotation (Placement(transformation(extent={{-110,-110},{-90,-90}})));
  Modelica.Mechanics.Translational.Interfaces.Support supportT(s=s_support, f=-flangeT.f) if useSupportT "Translational housing"
    annotation (Placement(transformation(extent={{90,-110},{110,-90}})));
  parameter Real ratio(final unit="rad/m", start=1) "Angle of flangeR by the position of flangeT";
protected
  SI.Angle phi_support "Angle of the rotational housing";
  SI.Position s_support "Position of the translational housing";
equation
  if not useSupportR then
    phi_support = 0;
  end if;
  if not useSupportT then
    s_support = 0;
  end if;
  flangeR.phi - phi_support = ratio*(flangeT.s - s_support);
  0 = ratio*flangeR.tau + flangeT.f;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-60,60},{20,-20}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{-70,-20},{100,-40}}, lineColor={70,70,70}, fillColor={150,150,150}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A pinion on a rack: <code>ratio</code> is the inverse of the radius of the pinion.</p></html>"));
end IdealGearR2T;
