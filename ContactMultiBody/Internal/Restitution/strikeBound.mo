within ContactMultiBody.Internal.Restitution;
pure function strikeBound "Approach speed from which on a contact is struck anew, after a strike"
  extends Modelica.Icons.Function;
  import SI = Modelica.Units.SI;
  input SI.Velocity impactSpeed "Impact speed before the strike";
  input SI.Velocity strikeSpeed "Approach speed now";
  input SI.Velocity restSpeed "Strikes slower than this are none";
  input Boolean struck "= true, if the bound was exceeded just now";
  output SI.Velocity bound "Bound, that of light while the strike is to be followed";
protected
  SI.Velocity first "Speed that strikes are measured by";
algorithm
  first := max(impactSpeed, restSpeed);
  bound := if strikeSpeed < newStrike*first and (struck or strikeSpeed > sameStrike*first) then Modelica.Constants.c else
    sameStrike*max(struckSpeed(impactSpeed, strikeSpeed, restSpeed), restSpeed);
  annotation (Documentation(info="<html>
<p>An approach that just exceeds its bound hardly changes the <a href=\"modelica://ContactMultiBody.Internal.Restitution.struckSpeed\">impact speed</a>, nor would a bound that follows it. So it is looked at again soon.</p>
</html>"));
end strikeBound;
