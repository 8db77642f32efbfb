within AntonWalk;
pure function freeShare "How far a group of legs is between lifting and setting down"
  extends Modelica.Icons.Function;
  input Real cycle(unit="1") "Cycles since the start";
  input Real dutyFactor(unit="1") "Share of a cycle in which a foot stands";
  output Real share(unit="1") "0 while all feet stand, 1 in the middle of a swing";
protected
  Real half(unit="1") "Place in the half of the cycle between two middles of standing on all feet";
  Real both(unit="1") "Share of the cycle from there to lifting";
  Real s(unit="1") "Share of the swing that is over";
algorithm
  half := cycle - 0.5*floor(2*cycle);
  both := (dutyFactor - 0.5)/2;
  s := max(0, min(1, (half - both)/(0.5 - 2*both)));
  share := 16*(s*(1 - s))^2;
  annotation (Inline=false, Documentation(info="<html>
<p>See <a href=\"modelica://AntonWalk.Steered\">Steered</a>.</p>
</html>"));
end freeShare;
