within Modelica.Mechanics.MultiBody.Interfaces;
partial model PartialTwoFrames "Component with frame_a and frame_b"
  Interfaces.Frame_a frame_a "First frame"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Interfaces.Frame_b frame_b "Second frame"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
protected
  outer Modelica.Mechanics.MultiBody.World world;
  annotation (Documentation(info="<html><p>Base class of components with two frames.</p></html>"));
end PartialTwoFrames;
