within ContactMultiBody.Internal.Restitution;
pure function struckSpeed "Impact speed of a contact that is struck while it lasts"
  extends Modelica.Icons.Function;
  import SI = Modelica.Units.SI;
  input SI.Velocity impactSpeed "Impact speed up to now";
  input SI.Velocity strikeSpeed "Approach speed now";
  input SI.Velocity restSpeed "Strikes slower than this are none";
  output SI.Velocity struckSpeed "Impact speed from now on";
protected
  SI.Velocity first "Speed that strikes are measured by";
algorithm
  first := max(impactSpeed, restSpeed);
  struckSpeed := if strikeSpeed <= sameStrike*first then impactSpeed elseif strikeSpeed >= newStrike*first then strikeSpeed else
    impactSpeed + (strikeSpeed - sameStrike*first)/((newStrike - sameStrike)*first)*(newStrike*first - impactSpeed);
  annotation (Documentation(info="<html>
<p>
Weight and other forces let bodies approach somewhat faster at first than when they touched: up to 1.25 times the impact speed the contact goes on as it began. From 1.5 times on the approach speed is
the impact speed of another strike. In between it changes continuously from one to the other, so that an approach that just reaches 1.25 times, and may or may not be seen by a solver, changes nothing.
</p>
<p>
A strike is looked at when it exceeds 1.25 times the impact speed, and as long as it does again whenever its depth has grown by <a href=\"modelica://ContactMultiBody.Internal.Restitution.timeToLook\">a tenth</a>.
</p>
</html>"));
end struckSpeed;
