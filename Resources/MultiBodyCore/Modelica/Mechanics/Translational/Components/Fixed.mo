within Modelica.Mechanics.Translational.Components;
model Fixed "Flange that stands still"
  parameter SI.Position s0=0 "Position of the flange";
  Interfaces.Flange_b flange "Flange at rest" annotation (Placement(transformation(extent={{-10,-10},{10,10}})));
equation
  flange.s = s0;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-60,-30},{60,-30}}, color={70,70,70}, thickness=1),
        Line(points={{0,0},{0,-30}}, color={70,70,70}),
        Line(points={{-40,-60},{-20,-30}}, color={70,70,70}),
        Line(points={{0,-60},{20,-30}}, color={70,70,70}),
        Line(points={{40,-60},{60,-30}}, color={70,70,70}),
        Text(extent={{-150,-70},{150,-105}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A flange fixed to the housing at <code>s0</code>.</p></html>"));
end Fixed;
