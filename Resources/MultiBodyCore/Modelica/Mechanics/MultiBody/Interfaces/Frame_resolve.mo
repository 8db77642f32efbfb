within Modelica.Mechanics.MultiBody.Interfaces;
connector Frame_resolve "Frame whose orientation alone matters"
  extends Frame;
  annotation (defaultComponentName="frame_resolve",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}, initialScale=0.16), graphics={
        Rectangle(extent={{-40,100},{40,-100}}, lineColor={70,70,70}, pattern=LinePattern.Dash, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>Says in which frame a vector is resolved. No force or torque passes through it.</p></html>"));
end Frame_resolve;
