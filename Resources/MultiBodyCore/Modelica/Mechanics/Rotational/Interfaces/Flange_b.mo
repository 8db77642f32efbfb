within Modelica.Mechanics.Rotational.Interfaces;
connector Flange_b "End of a shaft, open"
  extends Flange;
  annotation (defaultComponentName="flange_b",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-80,80},{80,-80}}, lineColor={80,80,80}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>The same as Flange_a but for the picture.</p></html>"));
end Flange_b;
