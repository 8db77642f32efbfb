within ContactMultiBodyTest.Sliding;
model StickingOnIncline "A box on an incline of 16 degrees stays, with coefficient 0.3"
  extends Modelica.Icons.Example;
  extends ContactMultiBody.Examples.BoxOnIncline(angle=Modelica.Units.Conversions.from_deg(16), contacts(friction=
          ContactMultiBody.Types.Friction.Anchored));
  annotation (experiment(StopTime=60, Tolerance=1e-8), Documentation(info="<html>
<p>tan(16 degrees) = 0.2867. The box moves by the stretch of its spring and no further: no creep.</p>
</html>"));
end StickingOnIncline;
