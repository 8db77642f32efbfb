within Modelica.Icons;
type TypeString = String "Text with the icon of types"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-90,90},{90,-90}}, lineColor={60,60,60}, radius=20),
        Text(extent={{-60,60},{60,-60}}, textColor={60,60,60}, textString="S")}),
      Documentation(info="<html><p>A <code>String</code> with an icon.</p></html>"));
