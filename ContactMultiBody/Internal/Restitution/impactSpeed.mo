within ContactMultiBody.Internal.Restitution;
pure function impactSpeed "Impact speed of a contact that may have been struck anew"
  extends Modelica.Icons.Function;
  import SI = Modelica.Units.SI;
  input SI.Velocity touchSpeed "Approach speed when the contact began";
  input SI.Velocity reachedSpeed "Approach speed that strikes have reached since then";
  input SI.Velocity restSpeed "Strikes slower than this are none";
  output SI.Velocity impactSpeed "Impact speed";
protected
  constant Real sameStrike(unit="1")=1.25 "Approach by the speed at the start up to which it is the same strike";
  constant Real newStrike(unit="1")=1.5 "The same from which on it is a strike of its own";
  SI.Velocity first "Speed at its start";
algorithm
  first := max(touchSpeed, restSpeed);
  impactSpeed := if reachedSpeed < sameStrike*first then touchSpeed elseif reachedSpeed > newStrike*first then reachedSpeed else
    touchSpeed + (reachedSpeed - sameStrike*first)/((newStrike - sameStrike)*first)*(newStrike*first - touchSpeed);
  annotation (Documentation(info="<html>
<p>
Weight and other forces let bodies approach somewhat faster at first than when they touched: up to 1.25 times the speed at the start the contact goes on as it began. From 1.5 times on the greatest approach speed
is the impact speed. In between it changes continuously from one to the other, so that no speed decides on what happens.
</p>
</html>"));
end impactSpeed;
