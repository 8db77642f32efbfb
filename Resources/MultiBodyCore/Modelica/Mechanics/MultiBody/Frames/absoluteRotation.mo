within Modelica.Mechanics.MultiBody.Frames;
function absoluteRotation "Absolute orientation of frame 2 from that of frame 1 and a relative one"
  extends Modelica.Icons.Function;
  input Orientation R1 "Absolute orientation of frame 1";
  input Orientation R_rel "Orientation of frame 2 with respect to frame 1";
  output Orientation R2 "Absolute orientation of frame 2";
algorithm
  R2 := Orientation(T=R_rel.T*R1.T, w=R_rel.T*R1.w + R_rel.w);
  annotation (Inline=true, Documentation(info="<html>
<p>Rotations multiply, angular velocities add once resolved in the same frame.</p></html>"));
end absoluteRotation;
