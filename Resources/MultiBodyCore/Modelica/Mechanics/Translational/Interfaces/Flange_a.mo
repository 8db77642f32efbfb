within Modelica.Mechanics.Translational.Interfaces;
connector Flange_a "End of a rod, filled"
  extends Flange;
  annotation (defaultComponentName="flange_a",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,80},{80,-80}}, lineColor={0,110,0}, fillColor={0,110,0}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>The same as Flange_b but for the picture.</p></html>"));
end Flange_a;
