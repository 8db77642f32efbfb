within Modelica.Mechanics.Rotational.Interfaces;
connector Flange_a "End of a shaft, filled"
  extends Flange;
  annotation (defaultComponentName="flange_a",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-80,80},{80,-80}}, lineColor={80,80,80}, fillColor={140,140,140}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>The same as Flange_b but for the picture.</p></html>"));
end Flange_a;
