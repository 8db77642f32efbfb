within Modelica.Mechanics.MultiBody.Interfaces;
model ZeroPosition "Frame that coincides with the world frame and takes no load"
  extends Modelica.Blocks.Icons.Block;
  Interfaces.Frame_resolve frame_resolve "Frame at the world frame"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
equation
  Connections.root(frame_resolve.R);
  frame_resolve.R = Frames.nullRotation();
  frame_resolve.r_0 = zeros(3);
  annotation (Documentation(info="<html><p>Stands in where a frame to resolve in is not needed.</p></html>"));
end ZeroPosition;
