within AntonWalk;
pure function limited "A number within a bound to either side"
  extends Modelica.Icons.Function;
  input Real u "Number";
  input Real bound(min=0) "Bound";
  output Real y "The number, or the bound of its sign";
algorithm
  y := max(-bound, min(bound, u));
  annotation (Inline=false);
end limited;
