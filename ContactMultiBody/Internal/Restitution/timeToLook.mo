within ContactMultiBody.Internal.Restitution;
pure function timeToLook "Time after which strikes that are followed are looked at again"
  extends Modelica.Icons.Function;
  import SI = Modelica.Units.SI;
  input SI.Length depth[:, :] "Penetration depths";
  input SI.Velocity strikeSpeed[size(depth, 1)] "Approach speed of each pair, 0 if it does not touch";
  input SI.Velocity bound[size(depth, 1)] "Approach speed from which on each pair is struck anew, that of light if it is followed";
  output SI.Time span "Time, infinite if no strike is followed";
protected
  constant Real growth(unit="1")=0.1 "Share by which the depth grows until then";
algorithm
  span := Modelica.Constants.inf;
  for i in 1:size(depth, 1) loop
    if bound[i] >= Modelica.Constants.c and strikeSpeed[i] > 0 then
      span := min(span, growth*max(depth[i, k] for k in 1:size(depth, 2))/strikeSpeed[i]);
    end if;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>The depth of the deepest point grows by a tenth until then if the approach goes on as fast. A time that does not depend on when an approach is fastest keeps what is seen continuous.</p>
</html>"));
end timeToLook;
