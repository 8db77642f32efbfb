within Modelica.Mechanics.MultiBody.Frames;
function inverseRotation "Orientation of frame 1 with respect to frame 2"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  output Orientation R_inv "Orientation of frame 1 with respect to frame 2";
algorithm
  R_inv := Orientation(T=transpose(R.T), w=-(transpose(R.T)*R.w));
  annotation (Inline=true, Documentation(info="<html>
<p>The transpose, and the opposite angular velocity resolved in frame 1.</p></html>"));
end inverseRotation;
