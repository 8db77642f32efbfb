within CoreFixtures;
model MathFunctions "Functions of Math and Units.Conversions"
  extends Modelica.Icons.Example;
  Real x = 0.2 + 0.3*time;
  Real y[13] = {Modelica.Math.sin(x), Modelica.Math.cos(x), Modelica.Math.tan(x), Modelica.Math.asin(x), Modelica.Math.acos(x), Modelica.Math.atan(x),
    Modelica.Math.atan2(-x, -2), Modelica.Math.sinh(x), Modelica.Math.cosh(x), Modelica.Math.tanh(x), Modelica.Math.exp(x), Modelica.Math.log(x),
    Modelica.Math.log10(x)};
  Real c[7] = {Modelica.Units.Conversions.to_deg(x), Modelica.Units.Conversions.from_deg(x), Modelica.Units.Conversions.to_rpm(x),
    Modelica.Units.Conversions.from_rpm(x), Modelica.Units.Conversions.to_kmh(x), Modelica.Units.Conversions.from_kmh(x),
    Modelica.Units.Conversions.to_unit1(x)};
  Real k[5] = {Modelica.Constants.pi, Modelica.Constants.e, Modelica.Constants.g_n, Modelica.Constants.D2R, Modelica.Constants.R2D};
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end MathFunctions;
