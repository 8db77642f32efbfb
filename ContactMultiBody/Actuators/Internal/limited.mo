within ContactMultiBody.Actuators.Internal;
pure function limited "A number, cut off at both ends of a range around zero"
  extends Modelica.Icons.Function;
  input Real u "Number";
  input Real limit "Largest absolute value, not negative";
  output Real y "The number, or the limit with its sign";
algorithm
  y := min(limit, max(-limit, u));
  annotation (Inline=true, Documentation(info="<html>
<p>Continuous, with bends at both limits; no events.</p>
</html>"));
end limited;
